/// What each value of a measure stands for.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/perceptual.h>
#include <ssphh/report/measure.h>

#include "temp_dir.h"

namespace ssphh::report {
namespace {

using image::Image;

/// Every value is another, the channels are of different brightness.
Image coloured(int width, int height, float first) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float t = first + 0.01f * static_cast<float>(x + width * y);
      image.set_rgb(x, y, {t, 2 * t * t, 0.3f + std::sin(9 * t)});
    }
  }
  return image;
}

std::map<std::string, std::vector<double>> measured(const Image& reference, const Image& test,
                                                    const MeasureParams& params = {}) {
  return measure_layer({reference, {}}, {{test, {}}}, params).values;
}

double mean_of(const std::array<double, 3>& rgb) {
  return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

TEST(MeasureValues, AreThoseOfACompareByTheirNames) {
  Image reference = coloured(24, 17, 0.2f);
  reference.set_rgb(3, 4, vec3(NAN));
  const Image test = coloured(24, 17, 0.25f);
  const metrics::ImageError e = metrics::compare(reference, test);
  const auto values = measured(reference, test);
  const std::map<std::string, double> wanted = {{"mae", e.mae},
                                                {"rmse", e.rmse},
                                                {"mse", e.mse},
                                                {"relmse", e.relmse},
                                                {"mape", e.mape},
                                                {"max", e.max},
                                                {"smape", e.smape},
                                                {"bias", e.bias},
                                                {"sum", e.sum},
                                                {"nonfinite_pixels", 1},
                                                {"mean_ratio", mean_of(e.mean_ratio)}};
  for (const auto& [name, value] : wanted) EXPECT_EQ(values.at(name)[0], value) << name;
  const metrics::DisplayError display = metrics::display_error(reference, test);
  EXPECT_EQ(values.at("psnr")[0], display.psnr);
  EXPECT_EQ(values.at("ssim")[0], display.ssim);
}

// 10 × 10 pixels with mean errors 0..99, one of them per pixel: below the 95th of 100 lie 94.
TEST(MeasureValues, TheNinetyFifthPercentileIsOfAPixelsMeanError) {
  const Image reference(10, 10);
  Image test(10, 10);
  for (int i = 0; i < 100; ++i) {
    const auto error = static_cast<float>(i * 37 % 100);
    test.set_rgb(i % 10, i / 10, {3 * error, 0, 0});
  }
  EXPECT_EQ(measured(reference, test).at("error_p95")[0], 94);
}

TEST(MeasureValues, BlocksAreAsLargeAsAskedFor) {
  const Image reference(12, 12);
  Image test(12, 12);
  test.set_rgb(5, 5, {1, 2, 4}), test.set_rgb(6, 5, {8, 0, 0});
  const auto values = measured(reference, test, {6, {}});
  EXPECT_EQ(values.at("block_max")[0], 8) << "the two lie in different blocks";
  EXPECT_EQ(values.at("block_mean")[0], 15.0 / 4);
  EXPECT_EQ(measured(reference, test, {12, {}}).at("block_max")[0], 15);
}

// An inset holds the pixels from the whole number below its left and upper edge to that below its right and
// lower.
TEST(MeasureValues, OfAnInsetAreThoseOfItsPixels) {
  const Image reference = coloured(20, 16, 0.2f), test = coloured(20, 16, 0.25f);
  const auto part = [](const Image& image) {
    Image cut(7, 5);
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 7; ++x) cut.set_rgb(x, y, image.rgb(4 + x, 3 + y));
    return cut;
  };
  // 0.22·20 = 4.4, 0.59·20 = 11.8; 0.2·16 = 3.2, 0.55·16 = 8.8.
  const auto values = measured(reference, test, {16, {{"i", 0.22, 0.2, 0.59, 0.55}}});
  const metrics::ImageError e = metrics::compare(part(reference), part(test));
  EXPECT_EQ(values.at("relmse@i")[0], e.relmse);
  EXPECT_EQ(values.at("mean_ratio@i")[0], mean_of(e.mean_ratio));
  EXPECT_EQ(measured(reference, test, {16, {{"i", 0.2, 0.2, 0.201, 0.201}}}).at("relmse@i").size(), 1u)
      << "never without a pixel";
}

// The mean of variance/(r² + ε): the grey levels 0.1 and 1 with the variances 0.02 and 0.3.
TEST(MeasureValues, NoiseIsRelativeToTheReference) {
  Image reference(2, 1), variance(2, 1);
  reference.set_rgb(0, 0, vec3(0.1f)), reference.set_rgb(1, 0, vec3(1));
  variance.set_rgb(0, 0, vec3(0.02f)), variance.set_rgb(1, 0, vec3(0.3f));
  const auto values = measure_layer({reference, variance}, {{reference, variance}}, {}).values;
  const double wanted =
      0.5 * (0.02 / (0.01 + metrics::relative_epsilon) + 0.3 / (1 + metrics::relative_epsilon));
  EXPECT_NEAR(values.at("noise_reference")[0], wanted, 1e-6);  // of float pixels
  EXPECT_NEAR(values.at("noise")[0], wanted, 1e-6);
  EXPECT_NEAR(values.at("relmse_method")[0], -wanted, 1e-6);
  EXPECT_NEAR(values.at("relmse_bias")[0], -2 * wanted, 1e-6);
}

// Two runs that differ by d have the variance d²/2 each; three with 0, 0, 3 have 3.
TEST(MeasureValues, VarianceBetweenRunsIsUnbiased) {
  const auto noise = [](const std::vector<float>& runs) {
    std::vector<LayerPicture> pictures;
    for (const float value : runs) {
      Image image(8, 8);
      for (float& x : image.pixels) x = value;
      pictures.push_back({image, {}});
    }
    Image reference(8, 8);
    for (float& x : reference.pixels) x = 2;
    return measure_layer({reference, {}}, pictures, {}).values.at("noise")[0] *
           (4 + metrics::relative_epsilon);
  };
  EXPECT_NEAR(noise({1, 3}), 2, 1e-6);
  EXPECT_NEAR(noise({0, 0, 3}), 3, 1e-6);
}

TEST(MeasureValues, IrradianceIsLeftOutWhereAChannelOfTheAlbedoIsBelowAHundredth) {
  const test::TempDir dir;
  Image light(2, 1), albedo(2, 1);
  light.set_rgb(0, 0, {0.1f, 0.2f, 0.3f}), light.set_rgb(1, 0, {0.1f, 0.2f, 0.3f});
  albedo.set_rgb(0, 0, {0.5f, 0.0101f, 0.25f}), albedo.set_rgb(1, 0, {0.5f, 0.5f, 0.0099f});
  image::write_image(dir / "o.indirect.exr", light);
  image::write_image(dir / "o.albedo.exr", albedo);
  const Image irradiance = load_layer({dir / "o.exr"}, "irradiance").picture;
  const vec3 e = irradiance.rgb(0, 0);  // πL/ρ
  EXPECT_NEAR(e.x, pi * 0.1f / 0.5f, 1e-5f);
  EXPECT_NEAR(e.y, pi * 0.2f / 0.0101f, 1e-3f);
  EXPECT_NEAR(e.z, pi * 0.3f / 0.25f, 1e-5f);
  EXPECT_TRUE(std::isnan(irradiance.rgb(1, 0).x));
}

// White from column 2 to 4 and from row 1 to 2 of 8 × 5 pixels.
TEST(MeasureValues, AMaskIsBoundedOnEverySide) {
  const test::TempDir dir;
  Image mask(8, 5);
  for (int y = 1; y <= 2; ++y)
    for (int x = 2; x <= 4; ++x) mask.set_rgb(x, y, vec3(1));
  image::write_image(dir / "mask.png", mask);
  Plan plan;
  plan.scenes.resize(1);
  plan.scenes[0].insets.push_back({.name = "m", .mask_file = "mask.png"});
  load_masks(plan, dir.path());
  const Inset& inset = plan.scenes[0].insets[0];
  EXPECT_DOUBLE_EQ(inset.x0, 2.0 / 8);
  EXPECT_DOUBLE_EQ(inset.x1, 5.0 / 8);
  EXPECT_DOUBLE_EQ(inset.y0, 1.0 / 5);
  EXPECT_DOUBLE_EQ(inset.y1, 3.0 / 5);
}

}  // namespace
}  // namespace ssphh::report
