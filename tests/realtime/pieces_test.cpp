// A frame drawn in pieces, between which the host draws things of its own.

#include <optional>

#include <gtest/gtest.h>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/scene/builtin.h>

#include "gl_context.h"
#include "pictures.h"

namespace ssphh::test {
namespace {

using realtime::FrameSettings;
using realtime::Renderer;
using realtime::Target;
using realtime::View;

class Pieces : public WithGl {
 protected:
  /// What a window's interface may leave behind.
  void disturb() {
    if (!elsewhere_) {
      elsewhere_.emplace(gl::Format::rgba8, 8, 8);
      sampler_.emplace(gl::Address::repeat, gl::Address::clamp, true);
    }
    const gl::Texture* const to[] = {&*elsewhere_};
    gl::bind_framebuffer(gl::Framebuffer(to, nullptr).id(), {0, 0, 5, 3});
    gl::apply({.blend = gl::Blend::over, .cull = gl::Cull::back, .color_write = false});
    for (unsigned unit = 0; unit < 2; ++unit) elsewhere_->bind(unit);
    sampler_->bind(0);
  }
  int draw_in_pieces(Renderer& renderer, const scene::CameraPose& camera, const FrameSettings& settings,
                     const Target& target) {
    renderer.begin(camera, settings, target);
    int pieces = 1;
    for (disturb(); renderer.step(); ++pieces) disturb();
    return pieces;
  }

  std::optional<gl::Texture> elsewhere_;
  std::optional<gl::Sampler> sampler_;
};

TEST_F(Pieces, AreTheSamePictureToTheBit) {
  for (const char* name : {"two-rooms"}) {
    scene::Scene scene = scene::make_builtin(name);
    scene.materials[0].specular_roughness = 0.2f;
    scene.materials.back().transmission = 0.5f;
    Renderer whole(gl(), scene, small_maps), parts(gl(), scene, small_maps);
    for (Renderer* renderer : {&whole, &parts}) renderer->set_probes(made_up_probes(scene));
    const scene::CameraPose camera = scene::camera_pose(scene, "");
    const gl::Texture color(gl::Format::rgba8, 72, 50), depth(gl::Format::depth32f, 72, 50);
    const gl::Texture* const colors[] = {&color};
    const gl::Framebuffer framebuffer(colors, &depth);
    const Target target{72, 50, framebuffer.id(), 0, 0};
    const auto shown = [&] {
      std::vector<float> texels(72 * 50 * 4);
      color.read(texels, 4);
      return texels;
    };
    for (const View view : {View::lit, View::direct, View::shadow, View::chosen_sphl}) {
      for (const int scale : {1, 3}) {
        FrameSettings settings;
        settings.view = view;
        settings.indirect_scale = scale;
        settings.ambient_occlusion = scale == 1;
        settings.supersample = view == View::direct ? 2 : 1;
        whole.draw(camera, settings, target);
        const std::vector<float> expected = shown();
        const int pieces = draw_in_pieces(parts, camera, settings, target);
        EXPECT_EQ(parts.read_back().pixels, whole.read_back().pixels)
            << name << " " << static_cast<int>(view) << " " << scale;
        EXPECT_EQ(shown(), expected);
        EXPECT_GT(pieces, 2);
        EXPECT_EQ(parts.stats().shadow_maps_waiting, 0);
        EXPECT_EQ(parts.stats().triangles, whole.stats().triangles);
      }
    }
  }
}

/// Passes that took long are drawn in more bands the next time, shadow maps one at a time.
TEST_F(Pieces, AreManyWhereAFrameIsSlow) {
  if (!gl().info().software) GTEST_SKIP() << "a GPU's frames are not slow";
  const scene::Scene scene = scene::make_builtin("two-rooms");
  Renderer renderer(gl(), scene, small_maps);
  renderer.set_probes(made_up_probes(scene));
  const scene::CameraPose camera = scene::camera_pose(scene, "");
  const int first = draw_in_pieces(renderer, camera, {}, {.width = 16, .height = 16}),
            second = draw_in_pieces(renderer, camera, {}, {.width = 16, .height = 16});
  EXPECT_GT(first, 3 * 16) << "nobody knows yet how long each takes";
  EXPECT_LT(second, first) << "little of it is slow";
}

TEST_F(Pieces, AnotherFrameDropsWhatIsLeft) {
  const scene::Scene scene = scene::make_builtin("cornell");
  Renderer renderer(gl(), scene, small_maps);
  const scene::CameraPose camera = scene::camera_pose(scene, "");
  renderer.draw(camera, {}, {.width = 40, .height = 30});
  const image::Image expected = renderer.read_back();
  renderer.begin(camera, {}, {.width = 20, .height = 10});
  renderer.step();
  EXPECT_THROW(renderer.read_back(), Error) << "it is not whole yet";
  renderer.draw(camera, {}, {.width = 40, .height = 30});
  EXPECT_EQ(renderer.read_back().pixels, expected.pixels);
  EXPECT_FALSE(renderer.step()) << "nothing is left";
  const std::uint64_t calls = renderer.draw(camera, {}, {.width = 40, .height = 30}).draw_calls;
  renderer.begin(camera, {}, {.width = 40, .height = 30});
  EXPECT_EQ(renderer.draw(camera, {}, {.width = 40, .height = 30}).draw_calls, calls);
}

}  // namespace
}  // namespace ssphh::test
