/// The picture as it is shown: tone-mapped, encoded and in its place within somebody's framebuffer.

#include <algorithm>
#include <array>

#include <gmock/gmock.h>

#include <ssphh/gl/framebuffer.h>

#include "change_lighting.h"
#include "gl_context.h"
#include "pictures.h"
#include "stage_lamps.h"

namespace ssphh::test {
namespace {

using realtime::FrameSettings;
using realtime::Renderer;
using realtime::View;

constexpr PictureSize display_size{40, 24};
constexpr gl::Rect around{0, 0, 60, 50}, place{7, 15, display_size.width, display_size.height};

class Display : public WithGl {
 protected:
  void SetUp() override {
    WithGl::SetUp();
    if (IsSkipped()) return;
    scene::Light lamp = lamps_without_extent()[0].light;
    lamp.intensity = 60;  // some pixels are brighter than a display, most are not
    add_stage_lamp(scene_, lamp);
    renderer_.emplace(gl(), scene_);
    shown_ = gl::Texture(gl::Format::rgba8, around.width, around.height);
    framebuffer_ = gl::Framebuffer(std::array<const gl::Texture*, 1>{&shown_}, nullptr);
  }
  /// What stands in the frame's place, and then whether it is `grey` beside it.
  std::vector<std::uint8_t> shown(const FrameSettings& settings) {
    gl::bind_framebuffer(framebuffer_.id(), around);
    gl::clear_color(0, 0.2f, 0.2f, 0.2f, 0.2f);
    renderer_->draw(scene::camera_pose(scene_, ""), settings,
                    {.width = display_size.width,
                     .height = display_size.height,
                     .framebuffer = framebuffer_.id(),
                     .x = place.x,
                     .y = place.y});
    const std::vector<std::uint8_t> all = gl::read_pixels(framebuffer_.id(), around);
    for (int y = 0; y < around.height; ++y) {
      for (int x = 0; x < around.width; ++x) {
        const int up = around.height - 1 - y;
        if (x >= place.x && x < place.x + place.width && up >= place.y && up < place.y + place.height)
          continue;
        EXPECT_EQ(all[4 * (y * around.width + x)], 51) << x << ", " << y;
      }
    }
    return gl::read_pixels(framebuffer_.id(), place);
  }
  static void expect_shown(const std::vector<std::uint8_t>& shown,
                           const std::vector<std::uint8_t>& expected) {
    ASSERT_EQ(shown.size(), expected.size());
    int off = 0, one_off = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      off += std::abs(shown[i] - expected[i]) > 1;
      one_off += shown[i] != expected[i];
    }
    EXPECT_EQ(off, 0);
    // A display's conversion to 8 bits may err by 0.6 of them (OpenGL 4.5, 2.3.5)
    EXPECT_LT(one_off, static_cast<int>(shown.size()) / 10);
  }

  scene::Scene scene_ = stage(matte({0.9f, 0.3f, 0.5f}));
  std::optional<Renderer> renderer_;
  gl::Texture shown_;
  gl::Framebuffer framebuffer_;
};

TEST_F(Display, AFrameShownAgainHasTheBitsOfOneDrawnSo) {
  FrameSettings settings;
  settings.tone = {-2, image::ToneCurve::filmic, 0};
  const std::vector<std::uint8_t> dark = shown(settings);
  settings.tone = {1, image::ToneCurve::clip, 0};
  const std::vector<std::uint8_t> bright = shown(settings);
  const std::vector<float> light = renderer_->read_back().pixels;
  EXPECT_NE(dark, bright);
  renderer_->show_again({-2, image::ToneCurve::filmic, 0});
  EXPECT_EQ(gl::read_pixels(framebuffer_.id(), place), dark);
  renderer_->show_again({1, image::ToneCurve::clip, 0});
  EXPECT_EQ(gl::read_pixels(framebuffer_.id(), place), bright);
  EXPECT_EQ(renderer_->read_back().pixels, light);

  renderer_->draw(scene::camera_pose(scene_, ""), settings, {.width = 8, .height = 8});
  EXPECT_THROW(renderer_->show_again({}), Error) << "it was shown nowhere";
  EXPECT_THROW(Renderer(gl(), scene_).show_again({}), Error) << "nothing was drawn";
}

TEST_F(Display, ShowsLightAsTheCpusToneMapEncodesIt) {
  for (const image::ToneMap& tone : {image::ToneMap{},
                                     {1.5f, image::ToneCurve::clip, 0},
                                     {-1, image::ToneCurve::filmic, 0},
                                     {0.5f, image::ToneCurve::filmic, 2.2f},
                                     {0, image::ToneCurve::clip, 1.7f}}) {
    FrameSettings settings;
    settings.tone = tone;
    settings.view = tone.gamma > 0 ? View::direct : View::lit;
    const std::vector<std::uint8_t> picture = shown(settings);
    expect_shown(picture, image::to_display(renderer_->read_back(), tone).rgba);
    EXPECT_GT(std::ranges::count_if(picture, [](int v) { return v > 20 && v < 235; }), 1000);
  }
}

TEST_F(Display, ShowsLightThatIsBeyondAnyFloat) {
  change_lighting(*renderer_, [](auto& state) { state.lights[0].intensity = 1e7f; });
  FrameSettings settings;
  settings.tone.curve = image::ToneCurve::filmic, settings.tone.exposure = 20;
  const std::vector<std::uint8_t> picture = shown(settings);
  expect_shown(picture, image::to_display(renderer_->read_back(), settings.tone).rgba);
}

TEST_F(Display, ShowsWhatIsNoLightWithoutToneCurveOrEncoding) {
  FrameSettings settings;
  settings.tone = {3, image::ToneCurve::filmic, 2.2f};
  for (const View view : {View::albedo, View::normal, View::depth, View::shadow}) {
    settings.view = view;
    const std::vector<std::uint8_t> picture = shown(settings);
    const image::Image values = renderer_->read_back();
    std::vector<std::uint8_t> expected;
    for (std::size_t i = 0; i < values.pixels.size(); ++i) {
      expected.push_back(
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(values.pixels[i], 0.0f, 1.0f))));
      if (i % 3 == 2) expected.push_back(255);
    }
    expect_shown(picture, expected);
  }
}

TEST_F(Display, ShowsIndirectLightAsLight) {
  renderer_->set_probes(made_up_probes(std::vector{vec3(0, 2, 2)}));
  FrameSettings settings;
  settings.view = View::indirect, settings.tone.exposure = 1;
  const std::vector<std::uint8_t> picture = shown(settings);
  expect_shown(picture, image::to_display(renderer_->read_back(), settings.tone).rgba);
}

}  // namespace
}  // namespace ssphh::test
