#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/report/measure.h>

#include "temp_dir.h"

namespace ssphh::report {
namespace {

using image::Image;

Image noisy(const Image& mean, double sigma, std::mt19937& random) {
  std::normal_distribution<double> noise(0, sigma);
  Image image = mean;
  for (float& x : image.pixels) x += static_cast<float>(noise(random));
  return image;
}

Image constant(int width, int height, float value) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), value);
  return image;
}

// A bias of 0.1 and known noise in the reference and in the runs: each comes out by itself. The estimates are
// means over 64·64·3 squares of normal numbers: 5 σ of such a mean is 5·√(2/12288) = 6.4 %.
TEST(Measure, TellsBiasFromNoise) {
  std::mt19937 random(1);
  const int side = 64;
  const double bias = 0.1, sigma_reference = 0.01, sigma_run = 0.08;
  const Image truth = constant(side, side, 1), shifted = constant(side, side, 1 + static_cast<float>(bias));
  LayerPicture reference;
  const Image a = noisy(truth, sigma_reference * std::sqrt(2.0), random);
  const Image b = noisy(truth, sigma_reference * std::sqrt(2.0), random);
  reference.picture = reference.variance = a;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    reference.picture.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
    reference.variance.pixels[i] = 0.25f * std::pow(a.pixels[i] - b.pixels[i], 2.0f);
  }
  std::vector<LayerPicture> runs;
  for (int r = 0; r < 4; ++r) runs.push_back({noisy(shifted, sigma_run, random), {}});
  const auto values = measure_layer(reference, runs, {}).values;
  const auto mean = [&](const std::string& name) {
    double sum = 0;
    for (const double x : values.at(name)) sum += x / static_cast<double>(values.at(name).size());
    return sum;
  };
  // 1/(r² + ε) with r = 1. The reference's noise σ also stands in the denominator: 4·bias·σ² = 0.4 % of bias²
  // more. The mean of (bias + noise)² over four runs varies by 2·0.1·0.08/√49152 and 0.08²·√(2/49152): 5 σ
  // are 4 %.
  const double unit = 1 / 1.01;
  EXPECT_NEAR(mean("noise_reference"), sigma_reference * sigma_reference * unit,
              0.07 * sigma_reference * sigma_reference);
  EXPECT_NEAR(mean("noise"), sigma_run * sigma_run * unit, 0.05 * sigma_run * sigma_run);
  EXPECT_NEAR(mean("relmse_bias"), bias * bias * unit, 0.06 * bias * bias);
  EXPECT_NEAR(mean("relmse_method"), (bias * bias + sigma_run * sigma_run) * unit, 0.06 * bias * bias);
  EXPECT_EQ(values.at("relmse").size(), 4u);
}

TEST(Measure, WithoutHalvesOrRepetitionsNoiseIsUnknown) {
  const auto values = measure_layer({constant(8, 8, 1), {}}, {{constant(8, 8, 1.5f), {}}}, {}).values;
  EXPECT_FALSE(values.count("noise"));
  EXPECT_FALSE(values.count("relmse_bias"));
  EXPECT_FALSE(values.count("relmse_method"));
  EXPECT_DOUBLE_EQ(values.at("mae")[0], 0.5);
  EXPECT_DOUBLE_EQ(values.at("error_p95")[0], 0.5);
  EXPECT_DOUBLE_EQ(values.at("mean_ratio")[0], 1.5);
}

TEST(Measure, InsetsAreMeasuredByThemselves) {
  Image test = constant(8, 8, 1);
  for (int y = 0; y < 8; ++y) {
    for (int x = 4; x < 8; ++x) test.set_rgb(x, y, vec3(2));
  }
  const MeasureParams params{4, {{"left", 0, 0, 0.5, 1}, {"right", 0.5, 0, 1, 1}}};
  const auto values = measure_layer({constant(8, 8, 1), {}}, {{test, {}}}, params).values;
  EXPECT_EQ(values.at("relmse@left")[0], 0);
  EXPECT_DOUBLE_EQ(values.at("mean_ratio@right")[0], 2);
  EXPECT_DOUBLE_EQ(values.at("block_max")[0], 48);  // 4·4 pixels, 3 channels
}

TEST(Measure, SizesMustAgree) {
  EXPECT_THROW(measure_layer({constant(8, 8, 1), {}}, {{constant(8, 4, 1), {}}}, {}), Error);
}

TEST(Layers, HalvesAndIrradiance) {
  const test::TempDir dir;
  const auto write = [&](const std::string& name, float value) {
    image::write_image(dir / name, constant(2, 1, value));
  };
  write("a.exr", 1), write("b.exr", 3);
  const LayerPicture both = load_layer({dir / "a.exr", dir / "b.exr"}, "");
  EXPECT_EQ(both.picture.pixels[0], 2);
  EXPECT_EQ(both.variance.pixels[0], 1);
  write("a.indirect.exr", 0.5f);
  Image albedo = constant(2, 1, 0.25f);
  albedo.set_rgb(1, 0, vec3(0.25f, 0, 0.25f));
  image::write_image(dir / "a.albedo.exr", albedo);
  const Image light = load_layer({dir / "a.exr"}, "irradiance").picture;
  EXPECT_NEAR(light.rgb(0, 0).x, 2 * 3.14159265, 1e-5);  // πL/ρ
  EXPECT_TRUE(std::isnan(light.rgb(1, 0).x));
  EXPECT_THROW(load_layer({dir / "b.exr"}, "indirect"), Error);
}

// The mask is of another size than the pictures and white in its right half.
TEST(Measure, MaskedInsetsAreBoundedAndMeasuredByTheirPixelsAlone) {
  test::TempDir dir;
  Image mask(8, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 4; x < 8; ++x) mask.set_rgb(x, y, vec3(1));
  mask.set_rgb(7, 0, vec3(0));
  image::write_image(dir / "right.png", mask);
  Plan plan;
  plan.scenes.resize(1);
  plan.scenes[0].insets.push_back({.name = "right", .mask_file = "right.png"});
  load_masks(plan, dir.path());
  const Inset& inset = plan.scenes[0].insets[0];
  EXPECT_EQ(inset.x0, 0.5);
  EXPECT_EQ(inset.x1, 1);
  EXPECT_EQ(inset.y0, 0);

  const Image reference = constant(16, 8, 1);
  Image picture = constant(16, 8, 2);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x)
      if (x < 8 || (x >= 14 && y < 2)) picture.set_rgb(x, y, vec3(9));  // outside, also within the bounds
  const auto values = measure_layer({reference, {}}, {{picture, {}}}, {16, plan.scenes[0].insets}).values;
  EXPECT_FLOAT_EQ(static_cast<float>(values.at("mean_ratio@right")[0]), 2.0f);

  image::write_image(dir / "right.png", Image(8, 4));
  EXPECT_THROW(load_masks(plan, dir.path()), Error) << "black";
}

}  // namespace
}  // namespace ssphh::report
