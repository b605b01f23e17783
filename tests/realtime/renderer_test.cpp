/// What changes between frames changes the picture, and nothing else is done anew.

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/session_sets.h>

#include "change_lighting.h"
#include "count_allocations.h"
#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"

namespace ssphh {
namespace {

using realtime::FrameSettings;
using realtime::FrameStats;
using realtime::Renderer;
using realtime::View;

constexpr test::PictureSize small{64, 36};

class RendererTest : public test::WithGl {
 protected:
  RendererTest() : scene_(scene::make_builtin("two-rooms")) {}

  image::Image picture(Renderer& renderer, const std::string& camera, View view = View::lit) {
    FrameSettings settings;
    settings.view = view;
    renderer.draw(scene::camera_pose(scene_, camera), settings, {.width = 64, .height = 36});
    return renderer.read_back();
  }
  double brightness(Renderer& renderer, const std::string& camera, View view = View::lit) {
    return test::mean_luminance(picture(renderer, camera, view));
  }
  const FrameStats& frame(Renderer& renderer, const FrameSettings& settings = {}) {
    return renderer.draw(scene::camera_pose(scene_, ""), settings, {.width = 64, .height = 36});
  }

  /// Every pixel and channel: images and tiles of halves (fp16) round each picture by 2⁻¹¹, what they hold is
  /// summed and filtered with weights of both signs, and least where it is next to nothing.
  static test::PictureBounds scaled(image::Image picture, const vec3& scale) {
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      picture.pixels[i] *= scale[static_cast<glm::length_t>(i % 3)];
    return test::PictureBounds::around(picture, 4.0f / 2048, 1e-3f);
  }

  scene::Scene scene_;
};

TEST_F(RendererTest, ShadersCompileWithoutWarnings) {
  Renderer renderer(gl(), scene_);
  EXPECT_EQ(renderer.shader_warnings(), "");
}

TEST_F(RendererTest, AnOpenDoorLetsLightIntoRoomB) {
  Renderer renderer(gl(), scene_);
  const double shut = brightness(renderer, "room-b");
  test::change_lighting(renderer, [](auto& state) { state.time = 1; });
  const double open = brightness(renderer, "room-b");
  EXPECT_LT(shut, 1e-3);
  EXPECT_GT(open, 10 * shut + 1e-3);
  test::change_lighting(renderer, [](auto& state) { state.time = 0; });
  EXPECT_DOUBLE_EQ(brightness(renderer, "room-b"), shut);
}

TEST_F(RendererTest, OnlyMapsThatSeeWhatMovedAreDrawnAnew) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(test::made_up_probes(scene_));
  const int all = frame(renderer).shadow_maps_drawn;
  EXPECT_EQ(all, 6 + 6 * 6) << "a lamp and six probes";
  EXPECT_EQ(frame(renderer).shadow_maps_drawn, 0);
  test::change_lighting(renderer, [](auto& state) { state.time = 0.5f; });
  const int moved = frame(renderer).shadow_maps_drawn;
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, all / 2);
}

TEST_F(RendererTest, MapsBeyondTheFramesShareWait) {
  Renderer renderer(gl(), scene_, {.maps_per_frame = 10});
  renderer.set_probes(test::made_up_probes(scene_));
  int drawn = 0, frames = 0;
  do {
    const FrameStats& stats = frame(renderer);
    EXPECT_LE(stats.shadow_maps_drawn, 10);
    drawn += stats.shadow_maps_drawn;
    EXPECT_EQ(stats.shadow_maps_waiting, 42 - drawn);
  } while (drawn < 42 && ++frames < 10);
  EXPECT_EQ(drawn, 42);
}

TEST_F(RendererTest, ALampThatIsSetLooksLikeASceneWithThatLamp) {
  Renderer renderer(gl(), scene_);
  scene::LightingState state = renderer.lighting();
  state.lights[0].world[3] = vec4(-1, 1.5f, -0.8f, 1);
  state.lights[0].color = {0.2f, 0.5f, 1};
  renderer.set(state);
  const image::Image moved = picture(renderer, "room-a");
  Renderer other(gl(), scene::with_lighting(scene_, state));
  EXPECT_EQ(moved.pixels, picture(other, "room-a").pixels);
  state.lights[0].intensity = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(renderer.set(state), Error);
}

TEST_F(RendererTest, GroupsScaleTheirLight) {
  Renderer renderer(gl(), scene_);
  const image::Image before = picture(renderer, "room-a");
  const vec3 scale(3, 0.7f, 1.9f);
  test::change_lighting(renderer, [&](auto& state) { state.group_scales[0] = scale; });
  EXPECT_TRUE(test::picture_is(picture(renderer, "room-a"), scaled(before, scale)));
  test::change_lighting(renderer, [](auto& state) { state.group_scales[0] = vec3(0); });
  EXPECT_EQ(brightness(renderer, "room-a"), 0);
}

TEST_F(RendererTest, DirectAndIndirectAddUp) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(test::made_up_probes(scene_));
  image::Image sum = picture(renderer, "room-a", View::direct);
  const image::Image indirect = picture(renderer, "room-a", View::indirect);
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += indirect.pixels[i];
  EXPECT_TRUE(test::picture_is(picture(renderer, "room-a"), scaled(sum, vec3(1))));
}

TEST_F(RendererTest, ProbesChangeByWhatIsUploadedForThem) {
  Renderer renderer(gl(), scene_);
  probes::ProbeSet set = test::made_up_probes(scene_);
  renderer.set_probes(set);
  const image::Image before = picture(renderer, "room-a", View::indirect);
  const vec3 scale(2, 0.6f, 3.3f);
  std::vector<int> probes;
  std::vector<sh::RadianceSh> light;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    probes.push_back(static_cast<int>(i));
    light.push_back(set.probes[i].reflected);
    light.back() *= scale;
  }
  const std::uint64_t idle = frame(renderer).bytes_uploaded;
  renderer.update_probes(std::span(probes).first(1), std::span(light).first(1));
  const std::uint64_t one = frame(renderer).bytes_uploaded - idle;
  renderer.update_probes(probes, light);
  const std::uint64_t six = frame(renderer).bytes_uploaded - idle;
  EXPECT_GT(one, 0u);
  EXPECT_EQ(six, 6 * one);
  EXPECT_TRUE(test::picture_is(picture(renderer, "room-a", View::indirect), scaled(before, scale)));
  EXPECT_THROW(renderer.update_probes(std::array{6}, std::span(light).first(1)), Error);
}

TEST_F(RendererTest, FittedWeightsDoNotLeakThroughAShutDoor) {
  probes::ProbeSet set = test::made_up_probes(scene_);
  const trace::PathTracer tracer(scene_);
  // Light in room A alone: at probes that its lamp sees
  const vec3 lamp(test::light_world(scene_, 0)[3]);
  int lit = 0;
  for (probes::Probe& probe : set.probes) {
    const bool in_a = tracer.visible(probe.position, lamp);
    lit += in_a;
    for (probes::GroupLight& light : probe.groups) light.reflected *= vec3(in_a ? 1 : 0);
  }
  ASSERT_TRUE(lit > 0 && lit < static_cast<int>(set.probes.size()));
  probes::merge_groups(set);
  Renderer renderer(gl(), scene_);
  renderer.set_probes(set);
  renderer.set_fitted(test::prepared(scene_, test::made_up_fit(scene_, set, 400), tracer));
  EXPECT_GT(brightness(renderer, "room-a", View::indirect), 0.1);
  frame(renderer);
  renderer.draw(scene::camera_pose(scene_, "room-b"), {.view = View::indirect},
                {.width = 256, .height = 144});
  float brightest = 0;
  for (const float v : renderer.read_back().pixels) brightest = std::max(brightest, v);
  // Probes of room B are dark and points there name no others: what is not 0 has come through a wall
  EXPECT_EQ(brightest, 0);
}

TEST_F(RendererTest, NewLightOfAProbeCostsThePointsThatItLightsAlone) {
  const probes::ProbeSet set = test::made_up_probes(scene_);
  const trace::PathTracer tracer(scene_);
  const probes::FittedPoints fitted = test::made_up_fit(scene_, set, 200);
  std::size_t lit_by_it = 0;
  for (const probes::PointWeights& weights : fitted.weights) {
    for (const probes::ProbeWeight& weight : weights.used()) lit_by_it += weight.probe == 0;
  }
  Renderer renderer(gl(), scene_);
  renderer.set_probes(set);
  frame(renderer);
  const std::array<sh::RadianceSh, 1> light{set.probes[1].self};
  renderer.update_probes(std::array{0}, light);
  const std::uint64_t without = frame(renderer).bytes_uploaded;
  probes::FittedSurfaces prepared = test::prepared(scene_, fitted, tracer);
  renderer.set_fitted(prepared);
  frame(renderer);
  renderer.update_probes(std::array{0}, light);
  EXPECT_EQ(frame(renderer).bytes_uploaded - without, 64 * lit_by_it);

  // The same as all light new
  const image::Image updated = renderer.read_back();
  probes::ProbeSet changed = set;
  changed.probes[0].groups = set.probes[1].groups;
  probes::merge_groups(changed);
  renderer.set_probes(changed);
  renderer.set_fitted(prepared);
  frame(renderer);
  EXPECT_EQ(renderer.read_back().pixels, updated.pixels);

  prepared.weights[0].entries[0].probe = 99;
  EXPECT_THROW(renderer.set_fitted(prepared), Error);
}

TEST_F(RendererTest, RecordsLightSurfacesUntilFittedPointsTakeTheirPlace) {
  probes::ProbeSet set = test::made_up_probes(scene_);
  const trace::PathTracer tracer(scene_);
  const probes::FittedPoints fitted = test::made_up_fit(scene_, set, 400);
  const probes::SurfaceRecords records = test::made_up_records(fitted.points, set.light_groups);
  Renderer renderer(gl(), scene_);
  const auto picture = [&](probes::WeightMethod weights) {
    FrameSettings settings;
    settings.view = View::indirect;
    settings.weights = weights;
    frame(renderer, settings);
    return renderer.read_back().pixels;
  };
  renderer.set_probes(set);
  const auto by_probes = picture(probes::WeightMethod::mls);
  EXPECT_EQ(picture(probes::WeightMethod::surface), by_probes) << "there are none";
  const probes::SurfaceLists lists = test::listed(scene_, records.points, tracer);
  const auto set_records = [&] {
    renderer.set_records(lists);
    renderer.set_record_light(records.light);
  };
  set_records();
  const auto by_records = picture(probes::WeightMethod::surface);
  EXPECT_NE(by_records, by_probes);
  EXPECT_EQ(picture(probes::WeightMethod::mls), by_probes) << "asked for";
  EXPECT_EQ(picture(probes::WeightMethod::fitted), by_probes) << "records are no fitted points";

  // New light of the probes changes what moves and no record is near; new light of the records the rest, at
  // its price
  const std::array<sh::RadianceSh, 1> light{set.probes[1].self};
  renderer.update_probes(std::array{0}, light);
  const auto share = [&](const auto& changed) {
    const auto now = picture(probes::WeightMethod::surface);
    std::size_t count = 0;
    for (std::size_t i = 0; i < now.size(); ++i) count += changed(now[i], by_records[i]);
    return static_cast<double>(count) / static_cast<double>(now.size());
  };
  EXPECT_LT(share([](float now, float before) { return now != before; }), 0.2);
  frame(renderer);
  const std::uint64_t still = frame(renderer).bytes_uploaded;
  renderer.set_record_light(std::vector(records.points.size(), probes::RecordLight(0)));
  EXPECT_EQ(frame(renderer).bytes_uploaded - still, 64 * records.points.size());
  EXPECT_GT(share([](float now, float) { return now == 0; }), 0.7);
  EXPECT_THROW(renderer.set_record_light(std::span(records.light).first(3)), Error);

  const probes::FittedSurfaces prepared = test::prepared(scene_, fitted, tracer);
  renderer.set_fitted(prepared);
  const auto by_weights = picture(probes::WeightMethod::fitted);
  EXPECT_EQ(picture(probes::WeightMethod::surface), by_weights) << "the best there is";
  EXPECT_NE(by_weights, by_probes);
  EXPECT_THROW(renderer.set_record_light(records.light), Error);
  renderer.set_probes(set);
  set_records();
  EXPECT_EQ(picture(probes::WeightMethod::surface), by_records);
  renderer.set_records({});
  EXPECT_EQ(picture(probes::WeightMethod::surface), picture(probes::WeightMethod::mls));
}

TEST_F(RendererTest, OcclusionDarkensCornersAndNothingBrightens) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(test::made_up_probes(scene_));
  FrameSettings settings;
  settings.view = View::indirect;
  frame(renderer, settings);
  const image::Image open = renderer.read_back();
  settings.ambient_occlusion = true;
  frame(renderer, settings);
  const image::Image closed = renderer.read_back();
  for (std::size_t i = 0; i < open.pixels.size(); ++i)
    EXPECT_LE(closed.pixels[i], open.pixels[i] * 1.002f + 1e-6f);
  EXPECT_LT(test::mean_luminance(closed), 0.99 * test::mean_luminance(open));
}

TEST_F(RendererTest, AProbeThatEmitsLightsAsAPointLightOfItsIntensity) {
  // Radiance L from a sphere of radius r in every direction is the intensity L π r²
  scene::Scene dark = scene_;
  dark.lights.clear();
  probes::ProbeSet set = test::made_up_probes(scene_);
  set.probes[0].radius = 0.1f;
  Renderer probe(gl(), dark);
  probe.set_probes(set);
  sh::RadianceSh leaving(0);
  leaving[0] = vec3(50 / 0.28209479f);
  test::change_lighting(probe, [&](auto& state) { state.emission = {{0, leaving}}; });
  const double by_probe = brightness(probe, "room-a", View::direct);

  Renderer lamp(gl(), scene_);
  test::change_lighting(lamp, [&](auto& state) {
    state.lights[0] = {glm::translate(mat4(1), set.probes[0].position), vec3(1), 50 * pi * 0.01f};
  });
  const double by_lamp = brightness(lamp, "room-a", View::direct);
  EXPECT_NEAR(by_probe / by_lamp, 1, 0.01);
  test::change_lighting(probe, [](auto& state) { state.emission.clear(); });
  EXPECT_EQ(brightness(probe, "room-a", View::direct), 0);
}

TEST_F(RendererTest, FramesInSteadyStateAllocateNothing) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(test::made_up_probes(scene_));
  const scene::CameraPose camera = scene::camera_pose(scene_, "");
  const realtime::Target target{.width = 64, .height = 36};
  for (const int scale : {1, 3}) {
    FrameSettings settings;
    settings.indirect_scale = scale;
    for (int i = 0; i < 3; ++i) renderer.draw(camera, settings, target);
    const std::size_t memory = renderer.memory_bytes();
    const long before = test::allocations();
    for (int i = 0; i < 50; ++i) renderer.draw(camera, settings, target);
    EXPECT_EQ(test::allocations() - before, 0) << scale;
    EXPECT_EQ(renderer.memory_bytes(), memory) << scale;
  }
}

TEST_F(RendererTest, AStateThatDidNotChangeAllocatesNothing) {
  const trace::TransportScene source(scene_);
  transport::RelightParams params;
  params.transport = {.directions = 64, .surfel_size = 0.5f, .link_rays = 16};
  params.degree = 2;
  const probes::ProbeSet set = test::made_up_probes(scene_);
  transport::RelightSession session(source, scene::places_of(set.probes), params);
  Renderer renderer(gl(), scene_);
  renderer.set_probes(set);
  scene::LightingState state = rays::lighting_at(source, 0.5f);
  state.group_scales[0] = {1, 0.5f, 2};
  state.emission = {{1, sh::RadianceSh(2)}, {3, sh::RadianceSh(2)}};
  session.update(state);
  renderer.set(state);
  const long before = test::allocations();
  for (int i = 0; i < 50; ++i) {
    session.update(state);
    renderer.set(state);
  }
  EXPECT_EQ(test::allocations() - before, 0);
}

TEST_F(RendererTest, ViewsShowWhatTheyName) {
  Renderer renderer(gl(), scene_);
  renderer.set_probes(test::made_up_probes(scene_));
  FrameSettings settings;
  settings.view = View::albedo;
  frame(renderer, settings);
  const vec3 wall = renderer.read_back().rgb(10, 12);
  EXPECT_NEAR(wall.x, 0.7f, 0.01f);
  settings.view = View::normal;
  frame(renderer, settings);
  for (int x = 4; x < 60; x += 8) {
    const vec3 n = 2.0f * renderer.read_back().rgb(x, 12) - 1.0f;
    EXPECT_NEAR(glm::length(n), 1, 1e-2f);
  }
  settings.view = View::shadow;
  frame(renderer, settings);
  const image::Image shadow = renderer.read_back();
  for (const float v : shadow.pixels) EXPECT_TRUE(v >= 0 && v <= 1);
  settings.view = View::chosen_sphl;
  frame(renderer, settings);
  EXPECT_GT(test::mean_luminance(renderer.read_back()), 0);
}

TEST_F(RendererTest, TellsHowTheLastFrameProjectsSoThatOthersMayDrawIntoIt) {
  Renderer renderer(gl(), scene_);
  frame(renderer);
  EXPECT_NE(renderer.depth_texture().id(), 0u);
  const scene::CameraPose camera = scene::camera_pose(scene_, "");
  const float up = std::tan(0.5f * camera.camera.yfov), right = up * 64 / 36;
  for (const vec2& place : {vec2(0, 0), vec2(1, 0), vec2(-0.5f, 1)}) {
    for (const float distance : {0.5f, 3.0f}) {
      const vec4 world = camera.world * vec4(distance * vec3(place.x * right, place.y * up, -1), 1);
      const vec4 clip = renderer.view_projection() * world;
      EXPECT_NEAR(clip.w, distance, 1e-4f);
      EXPECT_NEAR(clip.x / clip.w, place.x, 1e-4f);
      EXPECT_NEAR(clip.y / clip.w, place.y, 1e-4f);
      EXPECT_TRUE(clip.z > 0 && clip.z < clip.w) << "1 at the near plane, 0 far away";
    }
  }
}

TEST_F(RendererTest, BadInputIsAnError) {
  Renderer renderer(gl(), scene_);
  EXPECT_THROW(renderer.read_back(), Error);
  EXPECT_THROW(renderer.set_probes({}), Error);
  EXPECT_THROW(renderer.draw(scene::camera_pose(scene_, ""), {}, {.width = 0, .height = 4}), Error);
  EXPECT_THROW(renderer.set_material(99, {}), Error);
  EXPECT_THROW(renderer.set({}), Error);
}

}  // namespace
}  // namespace ssphh
