// The mean of moved pictures, and when the window draws it.

#include <cmath>
#include <set>

#include "average_gl.h"
#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class Average : public test::WithGl {};

TEST_F(Average, IsThatOfTheLightOnTheScreen) {
  constexpr int size = 8;
  AverageGl average;
  const auto decoded = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const auto encoded = [](double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  };
  const auto value = [](int picture, int texel) { return (picture * 97 + texel * 31) % 256; };
  std::vector<double> sum(4 * size * size);
  for (int n = 0; n < 5; ++n) {
    gl::Texture picture(gl::Format::rgba8, size, size);
    std::vector<std::uint8_t> texels(sum.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
      texels[i] = static_cast<std::uint8_t>(value(n, static_cast<int>(i)));
      sum[i] += decoded(texels[i] / 255.0);
    }
    picture.upload(std::as_bytes(std::span(texels)));
    average.add(picture);
    EXPECT_EQ(average.count(), n + 1);
    std::vector<float> shown(sum.size());
    average.mean().read(shown, 4);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const double expected = i % 4 == 3 ? 1 : encoded(sum[i] / (n + 1));
      EXPECT_NEAR(static_cast<double>(shown[i]), expected, 0.6 / 255) << "after " << n + 1;
    }
  }
  average.clear();
  gl::Texture black(gl::Format::rgba8, size, size);
  const std::vector<std::uint8_t> zeros(4 * size * size, 0);
  black.upload(std::as_bytes(std::span(zeros)));
  average.add(black);
  std::vector<float> shown(zeros.size());
  average.mean().read(shown, 4);
  EXPECT_EQ(shown[0], 0) << "nothing of before";
  gl().throw_on_error("average");
}

TEST(PlaceInPixel, SpreadsOverThePixelAboutItsMiddle) {
  EXPECT_EQ(place_in_pixel(0), vec2(0));
  vec2 sum(0);
  int quarters[4] = {};
  for (int i = 0; i < App::smooth_pictures; ++i) {
    const vec2 p = place_in_pixel(i);
    EXPECT_LE(max_component(glm::abs(vec3(p, 0))), 0.5f);
    if (i > 0) ++quarters[(p.x < 0 ? 0 : 1) + (p.y < 0 ? 0 : 2)];
    sum += p;
  }
  EXPECT_LT(glm::length(sum / 16.0f), 0.06f) << "the picture stays where it is";
  for (const int q : quarters) EXPECT_GE(q, 3);
}

class SmoothPicture : public GlStage {
 protected:
  void prepare() override { options_.settings = {{"exposure", "0"}, {"debug", "albedo"}}; }
  void ready() override {
    app().open("builtin:cornell");
    window_->dropped.clear();
  }
  void settle() {
    for (int i = 0; i < 200 && !app().settled(); ++i) window_->clock += 0.05, app().turn({});
    ASSERT_TRUE(app().settled());
  }
  std::vector<std::uint8_t> pixels() { return app().picture.pixels().rgba; }
};

TEST_F(SmoothPicture, EdgesHaveStepsOnlyWhileSomethingMoves) {
  turn();
  EXPECT_FALSE(app().settled());
  const auto first = pixels();
  settle();
  EXPECT_EQ(app().picture.averaged(), App::smooth_pictures);
  const auto smooth = pixels();
  // Albedos are those of a few materials; between them there are none before.
  const auto colours = [](const std::vector<std::uint8_t>& p) {
    std::set<std::uint32_t> all;
    for (std::size_t i = 0; i < p.size(); i += 4)
      all.insert(static_cast<std::uint32_t>(p[i] << 16 | p[i + 1] << 8 | p[i + 2]));
    return all.size();
  };
  EXPECT_GT(colours(smooth), 2 * colours(first));
  // Each lies between what stands beside it.
  double far = 0;
  for (std::size_t i = 0; i < first.size(); ++i) far += std::abs(smooth[i] - first[i]);
  EXPECT_LT(far / static_cast<double>(first.size()), 12) << "it is the same picture";
  const int frames = window_->frames;
  for (int i = 0; i < 20; ++i) app().turn({});
  EXPECT_LE(window_->frames - frames, 4) << "nothing is left to be drawn";
  app().view = orbited(app().view, 0.1f, 0);
  turn();
  EXPECT_EQ(app().picture.averaged(), 1) << "begun anew";
}

TEST_F(SmoothPicture, NotWhereItIsMeasuredOrUnwanted) {
  settle();
  app().settings.antialias = false;
  settle();
  EXPECT_EQ(app().picture.averaged(), 0);
  const auto alone = pixels();
  app().settings.antialias = true;
  app().settings.show = Show::wipe;
  turn(), turn();
  EXPECT_EQ(app().picture.averaged(), 0);
  EXPECT_FALSE(app().picture.linear().empty());
  EXPECT_EQ(pixels(), alone);
  app().settings.show = Show::realtime;
  settle();
  EXPECT_EQ(app().picture.averaged(), App::smooth_pictures);
}

}  // namespace
}  // namespace ssphh::viewer
