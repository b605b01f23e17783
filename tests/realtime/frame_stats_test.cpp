/// What a frame tells of itself, and what a renderer does without being told.

#include <gmock/gmock.h>

#include <ssphh/gl/framebuffer.h>

#include "gl_context.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

using realtime::FrameSettings;
using realtime::FrameStats;
using realtime::Renderer;
using realtime::Target;
using realtime::View;
using testing::ElementsAre;

/// A wall of two triangles that fills the picture, and a lamp before it that shines at it alone.
scene::Scene wall_alone() {
  scene::Scene s;
  s.materials = {matte({0.5f, 0.4f, 0.3f})};
  add_mesh(s, scene::make_quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), 0);
  s.nodes.emplace_back().local.translation = {0, 0, 2};
  s.cameras.emplace_back().node = 1;
  scene::Light& lamp = s.lights.emplace_back();
  lamp.name = "lamp", lamp.node = 1, lamp.type = scene::LightType::spot, lamp.intensity = 10;
  lamp.outer_cone = 0.3f;
  scene::validate(s);
  return s;
}

class FrameStatsTest : public WithGl {
 protected:
  static constexpr Target target{.width = 16, .height = 8};

  const FrameStats& frame(Renderer& renderer, const FrameSettings& settings = {},
                          const Target& where = target) {
    return renderer.draw(scene::camera_pose(scene_, ""), settings, where);
  }
  static std::vector<std::string> passes_of(const FrameStats& stats) {
    std::vector<std::string> names;
    for (const realtime::PassTime& pass : stats.passes) names.emplace_back(pass.name);
    return names;
  }
  static probes::ProbeSet one_probe() { return made_up_probes(std::vector{vec3(0, 0, 1)}); }

  scene::Scene scene_ = wall_alone();
};

TEST_F(FrameStatsTest, PassesAreThoseThatTheViewNeeds) {
  Renderer renderer(gl(), scene_);
  const auto passes = [&](View view, const FrameSettings& rest = {}) {
    FrameSettings settings = rest;
    settings.view = view;
    return passes_of(frame(renderer, settings));
  };
  EXPECT_THAT(passes(View::lit), ElementsAre("shadows", "geometry", "direct", "seen"));
  EXPECT_THAT(passes(View::indirect), ElementsAre("shadows", "geometry")) << "there are no probes";
  EXPECT_THAT(passes(View::chosen_sphl), ElementsAre("shadows", "geometry"));
  renderer.set_probes(one_probe());
  EXPECT_THAT(passes(View::lit), ElementsAre("shadows", "geometry", "direct", "indirect", "seen"));
  EXPECT_THAT(passes(View::lit, {.direct = false}), ElementsAre("shadows", "geometry", "indirect"));
  EXPECT_THAT(passes(View::lit, {.indirect = false}), ElementsAre("shadows", "geometry", "direct", "seen"));
  EXPECT_THAT(passes(View::lit, {.supersample = 2}),
              ElementsAre("shadows", "geometry", "direct", "indirect", "seen", "resolve"));
  EXPECT_THAT(passes(View::direct), ElementsAre("shadows", "geometry", "direct", "seen"));
  EXPECT_THAT(passes(View::direct, {.direct = false}), ElementsAre("shadows", "geometry"));
  EXPECT_THAT(passes(View::indirect), ElementsAre("shadows", "geometry", "indirect"));
  EXPECT_THAT(passes(View::indirect, {.indirect = false}), ElementsAre("shadows", "geometry"));
  for (const View view : {View::albedo, View::normal, View::depth})
    EXPECT_THAT(passes(view), ElementsAre("shadows", "geometry", "seen"));
  EXPECT_THAT(passes(View::shadow), ElementsAre("shadows", "geometry", "direct", "seen"));
  EXPECT_THAT(passes(View::chosen_sphl, {.indirect = false}), ElementsAre("shadows", "geometry", "indirect"));
  const gl::Texture window(gl::Format::rgba8, 16, 8);
  const gl::Framebuffer framebuffer(std::array<const gl::Texture*, 1>{&window}, nullptr);
  EXPECT_THAT(passes_of(frame(renderer, {.direct = false, .indirect = false},
                              {.width = 16, .height = 8, .framebuffer = framebuffer.id()})),
              ElementsAre("shadows", "geometry", "display"));
}

TEST_F(FrameStatsTest, DrawsAndTrianglesAreCounted) {
  Renderer renderer(gl(), scene_);
  const FrameStats first = frame(renderer);
  EXPECT_EQ(first.shadow_maps_drawn, 1) << "its cone meets one face of the cube";
  EXPECT_EQ(first.draw_calls, 1u + 2 + 1) << "the map, the wall and its cracks, and the lamp's light on it";
  EXPECT_EQ(first.triangles, 2u * (1 + 1)) << "those of whole pictures do not count";
  const FrameStats second = frame(renderer);
  EXPECT_EQ(second.shadow_maps_drawn, 0);
  EXPECT_EQ(second.shadow_maps_waiting, 0);
  EXPECT_EQ(second.draw_calls, 3u);
  EXPECT_EQ(second.triangles, 2u);
  EXPECT_EQ(second.bytes_uploaded, 13u * 16) << "what shaders ask of a frame";
  renderer.set_probes(one_probe());
  frame(renderer);
  EXPECT_EQ(frame(renderer).draw_calls, 4u) << "and the probe's light";
  EXPECT_EQ(frame(renderer, {.supersample = 2}).draw_calls, 5u) << "and the mean of the samples";

  scene_.lights[0].type = scene::LightType::point;
  Renderer other(gl(), scene_);
  const FrameStats all = frame(other);
  EXPECT_EQ(all.shadow_maps_drawn, 6);
  EXPECT_EQ(all.draw_calls, 5u + 3) << "the face that looks away from the wall has nothing to draw";
}

TEST_F(FrameStatsTest, SamplesAreThoseOfTheSurfacesThatAreShown) {
  Renderer renderer(gl(), scene_);
  for (const int supersample : {1, 2, 3}) {
    // Known a frame later on a software renderer, which waits; of some frames ago on others
    for (int i = 0; i < 4; ++i) frame(renderer, {.supersample = supersample});
    if (!gl().info().software) renderer.read_back();
    EXPECT_EQ(frame(renderer, {.supersample = supersample}).samples_shaded,
              static_cast<std::uint64_t>(16 * 8 * supersample * supersample));
  }
}

TEST_F(FrameStatsTest, TimesOfPassesLieWithinTheFrames) {
  Renderer renderer(gl(), scene_);
  frame(renderer);
  const FrameStats stats = frame(renderer);
  double sum = 0;
  for (const realtime::PassTime& pass : stats.passes) {
    EXPECT_GT(pass.cpu_ms, 0) << pass.name;
    if (gl().info().software) {
      EXPECT_EQ(pass.gpu_ms, pass.cpu_ms);
    }
    sum += pass.cpu_ms;
  }
  EXPECT_LE(sum, stats.cpu_ms);
  EXPECT_LT(stats.cpu_ms, 60000) << "milliseconds";
}

TEST_F(FrameStatsTest, NumbersBeyondTheirRangeAreTheNearestWithin) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(one_probe());
  const auto picture = [&](int supersample, int scale) {
    frame(renderer, {.indirect_scale = scale, .supersample = supersample});
    return std::pair(renderer.memory_bytes(), renderer.read_back().pixels);
  };
  EXPECT_EQ(picture(0, 1), picture(1, 1));
  EXPECT_EQ(picture(-7, -3), picture(1, 1));
  EXPECT_EQ(picture(5, 1), picture(4, 1));
  EXPECT_NE(picture(4, 1).first, picture(3, 1).first);
  EXPECT_EQ(picture(1, 9), picture(1, 8));
  EXPECT_NE(picture(1, 8).first, picture(1, 7).first);
}

TEST_F(FrameStatsTest, MemoryGrowsByTheImagesOfAFrame) {
  Renderer renderer(gl(), scene_);
  const auto bytes = [&](int width, int height, int supersample, int scale) {
    frame(renderer, {.indirect_scale = scale, .supersample = supersample},
          {.width = width, .height = height});
    return renderer.memory_bytes();
  };
  const std::size_t none = bytes(1, 1, 1, 1);
  // Of a sample: 16 + 8 bytes of the surface, 8 of depth, 16 of radiance, 4 + 16 of occlusion and shadow
  EXPECT_EQ(bytes(20, 10, 1, 1) - none, 199u * 68);
  EXPECT_EQ(bytes(20, 10, 2, 1) - none, 799u * 68 + 200 * 16) << "and 16 of a pixel's mean";
  // Irradiance, mirrored radiance and planes of 7 × 4 places; a list of pixels with its head
  EXPECT_EQ(bytes(20, 10, 1, 3) - none, 199u * 68 + 28 * (16 + 16 + 16) + 200 * 4 + 16);
}

TEST_F(FrameStatsTest, WhatIsSwitchedOffDoesNotShine) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(one_probe());
  const auto mean = [&](const FrameSettings& settings) {
    frame(renderer, settings);
    return mean_luminance(renderer.read_back());
  };
  const double direct = mean({.indirect = false}), indirect = mean({.direct = false});
  EXPECT_GT(direct, 0);
  EXPECT_GT(indirect, 0);
  EXPECT_NEAR(mean({}), direct + indirect, 1e-5 * (direct + indirect));
  EXPECT_EQ(mean({.direct = false, .indirect = false}), 0);
  renderer.clear_probes();
  EXPECT_EQ(renderer.probe_count(), 0);
  EXPECT_NEAR(mean({}), direct, 1e-6 * direct);
}

TEST_F(FrameStatsTest, FrameWithoutAWordShowsAllLightAtEveryPixel) {
  const auto& [direct, indirect, lookup, weights, scale, tolerance, shift, supersample, occlusion, radius,
               view, sky, tone, wireframe] = FrameSettings{};
  EXPECT_TRUE(direct && indirect);
  EXPECT_EQ(lookup, probes::LookupMethod::irradiance);
  EXPECT_EQ(weights, probes::WeightMethod::surface);
  EXPECT_EQ(scale, 1);
  EXPECT_EQ(tolerance, 0.1f);
  EXPECT_EQ(shift, vec2(0));
  EXPECT_EQ(supersample, 1);
  EXPECT_FALSE(occlusion);
  EXPECT_EQ(radius, 0.5f);
  EXPECT_EQ(view, View::lit);
  EXPECT_EQ(sky, realtime::Sky::environment);
  EXPECT_EQ(tone.exposure, 0);
  EXPECT_EQ(tone.curve, image::ToneCurve::clip);
  EXPECT_EQ(tone.gamma, 0);
  EXPECT_FALSE(wireframe);
}

TEST_F(FrameStatsTest, RendererWithoutAWordHasTheSizesThatItsManualTells) {
  const auto& [directory, lamp, area, sun, suns, sky, probes, voxels, lights, area_samples, sun_samples,
               environment, maps] = realtime::RendererParams{};
  EXPECT_TRUE(directory.empty());
  EXPECT_EQ(lamp, 1024);
  EXPECT_EQ(area, 256);
  EXPECT_EQ(sun, 2048);
  EXPECT_EQ(suns, std::size_t{192} << 20);
  EXPECT_EQ(sky, 1024);
  EXPECT_EQ(probes, std::size_t{64} << 20);
  EXPECT_EQ(voxels, std::size_t{2} << 30);
  EXPECT_EQ(lights, std::size_t{256} << 20);
  EXPECT_EQ(area_samples, 16);
  EXPECT_EQ(sun_samples, 7);
  EXPECT_EQ(environment, 32);
  EXPECT_EQ(maps, 1 << 30);
  const auto& [width, height, framebuffer, x, y] = Target{};
  EXPECT_EQ(width, 1280);
  EXPECT_EQ(height, 720);
  EXPECT_EQ(framebuffer, Target::none);
  EXPECT_EQ(x, 0);
  EXPECT_EQ(y, 0);
}

TEST_F(FrameStatsTest, SizesOfMapsAreThoseThatAreAskedFor) {
  // A lamp's cube has six faces of 4 bytes a texel; they stand in four columns and two rows
  const auto bytes = [&](const realtime::RendererParams& params) {
    return Renderer(gl(), scene_, params).memory_bytes();
  };
  EXPECT_EQ(bytes({.light_map_size = 64}) - bytes({.light_map_size = 32}), 8u * 4 * (64 * 64 - 32 * 32));
  // Of a sun six cascades, halved until all fit
  scene::Scene sunny = scene_;
  sunny.lights.emplace_back().type = scene::LightType::directional;
  sunny.lights.back().node = 0;
  const auto of_sun = [&](int size, std::size_t most) {
    return Renderer(gl(), sunny, {.sun_map_size = size, .sun_map_bytes = most}).memory_bytes();
  };
  constexpr std::size_t whole_sun = 8u * 4 * 64 * 64;
  EXPECT_EQ(of_sun(64, whole_sun) - of_sun(32, whole_sun), 8u * 4 * (64 * 64 - 32 * 32));
  EXPECT_EQ(of_sun(64, whole_sun - 1), of_sun(32, whole_sun));
  // Of probes the largest power of two of 32 to 256 texels that fits
  const auto with_probe = [&](std::size_t most) {
    Renderer renderer(gl(), scene_, {.probe_map_bytes = most});
    const std::size_t before = renderer.memory_bytes();
    renderer.set_probes(one_probe());
    return renderer.memory_bytes() - before;
  };
  const std::size_t whole = 6u * 256 * 256 * 4;
  const auto texels = [](std::size_t side) { return 8 * 4 * side * side; };
  EXPECT_EQ(with_probe(whole) - with_probe(whole - 1), texels(256) - texels(128));
  EXPECT_EQ(with_probe(whole * 4), with_probe(whole));
  EXPECT_EQ(with_probe(6u * 64 * 64 * 4) - with_probe(0), texels(64) - texels(32));
}

}  // namespace
}  // namespace ssphh::test
