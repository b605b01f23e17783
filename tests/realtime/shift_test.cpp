// Pictures that are moved by parts of a pixel.

#include <gtest/gtest.h>

#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/builtin.h>

#include "gl_context.h"

namespace ssphh::realtime {
namespace {

constexpr int width = 60, height = 40;

class Shift : public test::WithGl {
 protected:
  void SetUp() override {
    test::WithGl::SetUp();
    if (!IsSkipped()) renderer_.emplace(gl(), scene_);
  }
  image::Image draw(const scene::CameraPose& camera, const vec2& shift, View view, int supersample = 1) {
    FrameSettings settings;
    settings.shift = shift;
    settings.view = view;
    settings.supersample = supersample;
    renderer_->draw(camera, settings, {.width = width, .height = height});
    return renderer_->read_back();
  }
  scene::CameraPose camera(bool orthographic) const {
    scene::CameraPose camera = scene::camera_pose(scene_, "");
    camera.camera.orthographic = orthographic;
    camera.camera.yheight = 2;
    return camera;
  }

  scene::Scene scene_ = scene::make_builtin("cornell");
  std::optional<Renderer> renderer_;
};

TEST_F(Shift, WholePixelsMoveThePicture) {
  for (const bool orthographic : {false, true}) {
    for (const View view : {View::lit, View::normal, View::depth}) {
      for (const int samples : {1, 2}) {
        const image::Image still = draw(camera(orthographic), vec2(0), view, samples),
                           moved = draw(camera(orthographic), vec2(3, 2), view, samples);
        int far = 0, all = 0;
        for (int y = 0; y + 2 < height; ++y) {
          for (int x = 3; x < width; ++x) {
            // Row 0 is on top
            const vec3 a = still.rgb(x - 3, y + 2), b = moved.rgb(x, y);
            far += max_component(glm::abs(a - b)) > 2e-3f * (1 + max_component(a));
            ++all;
          }
        }
        // An edge may fall on the pixel beside it by a rounding.
        EXPECT_LT(far, all / 50) << "orthographic " << orthographic << ", view " << static_cast<int>(view);
        const image::Image again = draw(camera(orthographic), vec2(0), view, samples);
        EXPECT_EQ(again.pixels, still.pixels);
      }
    }
  }
}

TEST_F(Shift, TheMatrixTellsOfIt) {
  for (const bool orthographic : {false, true}) {
    const vec4 point(0.3f, 0.4f, -0.5f, 1);
    const auto seen = [&](const vec2& shift) {
      draw(camera(orthographic), shift, View::lit);
      const vec4 clip = renderer_->view_projection() * point;
      return vec3(clip) / clip.w;
    };
    const vec3 still = seen(vec2(0)), moved = seen(vec2(0.25f, -0.5f));
    EXPECT_NEAR(moved.x - still.x, 2 * 0.25f / width, 1e-6f);
    EXPECT_NEAR(moved.y - still.y, -2 * 0.5f / height, 1e-6f);
    EXPECT_EQ(moved.z, still.z);
  }
}

}  // namespace
}  // namespace ssphh::realtime
