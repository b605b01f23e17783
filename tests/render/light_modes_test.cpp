/// Baked light groups: pictures with probes against path tracing.

#include <gtest/gtest.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/parallel.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/transport/session_sets.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

using scene::LightMode;

/// A table's worth of ground with a box on it, under a sky that is blue on one side and red on the other,
/// beside a lamp; four SPHLs around the box, and a board high up that moves.
scene::Scene open_ground() {
  scene::Scene scene;
  add_body(scene, "ground", scene::make_quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), vec3(0.6f, 0.5f, 0.4f));
  add_body(scene, "box", scene::make_box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}), vec3(0.3f, 0.6f, 0.5f));
  const int board = add_body(scene, "board", scene::make_quad({-0.2f, 0, 0.2f}, {0.4f, 0, 0}, {0, 0, -0.4f}),
                             vec3(0.5f), vec3(0), {1.6f, 1.5f, 1.6f});
  scene.animations.push_back({"drift", {}});
  scene.animations[0].channels.push_back({board,
                                          scene::AnimationPath::translation,
                                          scene::Interpolation::linear,
                                          {0, 1},
                                          {vec4(1.6f, 1.5f, 1.6f, 0), vec4(1.6f, 1.7f, 1.6f, 0)}});
  scene::Light& lamp = scene.lights.emplace_back();
  lamp.name = "lamp";
  lamp.color = vec3(1, 0.7f, 0.3f);
  lamp.intensity = 2;
  lamp.node = static_cast<int>(scene.nodes.size());
  scene.nodes.emplace_back().local.translation = {-1.5f, 1.2f, 1.5f};
  scene::Environment& sky = scene.environment.emplace();
  sky.group = "sky";
  sky.equirect = image::Image(16, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x)
      sky.equirect.set_rgb(x, y, x < 8 ? vec3(0.3f, 0.6f, 1.4f) : vec3(1.2f, 0.5f, 0.3f));
  }
  for (const vec3& at :
       {vec3(1.5f, 0.7f, 0), vec3(-1.5f, 0.7f, 0), vec3(0, 0.7f, 1.5f), vec3(0, 0.7f, -1.5f)})
    add_sphl(scene, "SPHL", at);
  scene::validate(scene);
  return scene;
}

/// Probes of the ground with modes of its groups, lamp and sky.
struct ModeBake {
  explicit ModeBake(const std::vector<LightMode>& modes, int points = 4096, int rays = 512,
                    float surfel_size = 0.12f)
      : source(scene) {
    bake::TransportBakeParams params;
    params.transport.directions = 1024;
    params.transport.surfel_size = surfel_size;
    params.records = {.points = points, .rays = rays, .baked = bake::baked_indices(modes)};
    bake::TransportBakeReport report;
    set = bake::bake_transport(source, place::init_from_scene(scene, 4), params, report);
    bake::set_light_modes(source, set, modes);
  }
  scene::Scene scene = open_ground();
  trace::TransportScene source;
  probes::ProbeSet set;
};

const ModeBake& sky_baked() {
  static const ModeBake bake({LightMode::realtime, LightMode::baked});
  return bake;
}

/// Few records and large surfels, for what does not look at their light.
ModeBake few(const std::vector<LightMode>& modes, int points = 256, int rays = 64) {
  return ModeBake(modes, points, rays, 0.3f);
}
/// The same so.
const ModeBake& sky_baked_into_few() {
  static const ModeBake bake = few({LightMode::realtime, LightMode::baked});
  return bake;
}

trace::RenderParams from_above(int spp) {
  trace::RenderParams params;
  params.width = 64, params.height = 48;
  params.camera.world = glm::inverse(glm::lookAt(vec3(2.5f, 4, 3.5f), vec3(0, 0.2f, 0), vec3(0, 1, 0)));
  params.camera.camera.yfov = 0.7f;
  params.path = {.max_depth = 8, .passes = 4, .spp = spp, .seed = 3};
  params.per_group = true;
  return params;
}

trace::RenderState looked_up(const scene::Scene& scene, const probes::ProbeSet& set, int spp) {
  const trace::PathTracer tracer(scene);
  const auto lookup = probes::make_lookup(probes::LookupSpec(), set, tracer);
  trace::RenderState state;
  tracer.render_with(*lookup, from_above(spp), state);
  return state;
}

trace::RenderState traced(const scene::Scene& scene, int spp) {
  trace::RenderState state;
  trace::PathTracer(scene).render(from_above(spp), state);
  return state;
}

/// Of the ground, by 64 paths for each pixel.
const trace::RenderState& truth_of_ground() {
  static const trace::RenderState state = traced(open_ground(), 16);
  return state;
}

/// As the probes of sky_baked() light it.
const trace::RenderState& looked_up_of_ground() {
  static const trace::RenderState state = looked_up(sky_baked().scene, sky_baked().set, 8);
  return state;
}

/// Mean of each channel, and the mean absolute difference of 8×8 blocks relative to it.
struct Difference {
  vec3 ratio{0}, of_blocks{0};
};

Difference compared(const image::Image& test, const image::Image& truth, float scale) {
  vec3 a(0), b(0), off(0);
  for (int y = 0; y < truth.height; y += 8) {
    for (int x = 0; x < truth.width; x += 8) {
      vec3 here(0), there(0);
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 8; ++i) here += scale * test.rgb(x + i, y + j), there += truth.rgb(x + i, y + j);
      }
      a += here, b += there, off += glm::abs(here - there);
    }
  }
  return {a / b, off / b};
}

float mean(const image::Image& image) {
  double sum = 0;
  for (const float v : image.pixels) sum += static_cast<double>(v);
  return static_cast<float>(sum / static_cast<double>(image.pixels.size()));
}

TEST(LightModesInPictures, ABakedSkyEqualsPathTracing) {
  const trace::RenderState& truth = truth_of_ground();
  const Difference all = compared(looked_up_of_ground().color, truth.color, 1);
  for (glm::length_t c = 0; c < 3; ++c) {
    // Records are as dense as to miss 4 % of a place's light at most; blocks of 64 pixels of 64 paths have
    // a noise under 1 % (two seeds differ by 0.3 %), and half of that tolerance is left for what all places
    // have in common.
    EXPECT_NEAR(all.ratio[c], 1, 0.02) << c;
    EXPECT_LT(all.of_blocks[c], 0.04) << c;
  }
}

TEST(LightModesInPictures, EveryGroupIsCountedOnce) {
  // Switched off in the set, a baked sky leaves nothing of its light but the sky as the eye sees it, and a
  // realtime one its direct light.
  const trace::RenderState& truth = truth_of_ground();
  for (const LightMode sky : {LightMode::realtime, LightMode::baked}) {
    SCOPED_TRACE(std::string(name_of(sky)));
    probes::ProbeSet set = sky == LightMode::baked
                               ? sky_baked().set
                               : ModeBake({LightMode::realtime, LightMode::realtime}, 4096, 128).set;
    const trace::RenderState with =
        sky == LightMode::baked ? looked_up_of_ground() : looked_up(sky_baked().scene, set, 8);
    probes::relight(set, "sky", vec3(0));
    const trace::RenderState without = looked_up(sky_baked().scene, set, 8);
    image::Image of_sky = with.indirect;
    for (std::size_t i = 0; i < of_sky.pixels.size(); ++i)
      of_sky.pixels[i] += with.groups[1].pixels[i] - without.indirect.pixels[i];
    const Difference difference = compared(of_sky, truth.groups[1], 1);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(difference.ratio[c], 1, 0.015) << c;
    // The groups and what is looked up add up to the picture.
    for (std::size_t i = 0; i < with.color.pixels.size(); ++i)
      ASSERT_NEAR(with.color.pixels[i], with.direct.pixels[i] + with.indirect.pixels[i],
                  1e-4f * (1 + with.color.pixels[i]));
  }
}

TEST(LightModesInPictures, RecordsOfABakedGroupHoldWhatPathTracingFinds) {
  // In colour, at the records themselves; the surfels' part of it is a tenth.
  const ModeBake& bake = sky_baked();
  const probes::SurfaceRecords& records = *bake.set.surface;
  scene::Scene sky_alone = bake.scene;
  sky_alone.lights[0].intensity = 0;
  const trace::PathTracer tracer(sky_alone);
  std::vector<rays::SurfacePoint> some;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < records.points.size(); i += records.points.size() / 50) {
    some.push_back(records.points[i]);
    which.push_back(i);
  }
  const auto truth = tracer.surface_irradiance(some, {.max_depth = 8, .passes = 1, .spp = 4096}, {});
  vec3 sum(0), off(0);
  for (std::size_t k = 0; k < some.size(); ++k) {
    const vec3 kept = probes::unpack(records.groups[1][which[k]], some[k].normal)[3] +
                      probes::unpack(records.direct[1][which[k]], some[k].normal)[3];
    const vec3 found = truth[k].direct + truth[k].indirect;
    sum += found, off += glm::abs(kept - found);
  }
  EXPECT_LT(max_component(off / sum), 0.02f);
}

TEST(LightModesInPictures, WhatMovesGetsBakedLightFromProbes) {
  // Nothing hides the sky from the board but the ground below it: E = ∫ L cos over the upper half, in colour.
  const ModeBake& bake = sky_baked_into_few();
  probes::ProbeSet set = bake.set;
  probes::relight(set, "lamp", vec3(0));
  scene::Scene sky_alone = bake.scene;
  sky_alone.lights[0].intensity = 0;
  const trace::PathTracer tracer(sky_alone);
  const auto lookup = probes::make_lookup(probes::LookupSpec(), set, tracer);
  const rays::SurfacePoint top{vec3(1.5f, 1.5f, 0.2f), vec3(0, 1, 0), true};
  const vec3 found = lookup->irradiance(top);
  const auto truth = tracer.surface_irradiance({&top, 1}, {.max_depth = 8, .passes = 1, .spp = 1 << 14}, {});
  const vec3 expected = truth[0].direct + truth[0].indirect;
  // Probes of degree 4 stand a metre away and half of a metre lower.
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 0.08) << c;
}

TEST(LightModesInPictures, LampsThatArePointsAreInProbesToo) {
  const ModeBake lamp = few({LightMode::baked, LightMode::realtime});
  for (const probes::Probe& probe : lamp.set.probes) {
    const vec3 way = vec3(-1.5f, 1.2f, 1.5f) - probe.position;
    const bool seen = trace::PathTracer(lamp.scene).visible(probe.position, vec3(-1.5f, 1.2f, 1.5f));
    const vec3 arriving =
        seen ? 2.0f / glm::dot(way, way) * vec3(1, 0.7f, 0.3f) : vec3(0);  // E of a plane that faces the lamp
    const vec3 mean = sh::mean(probe.groups[0].emitted) * (4 * pi);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], arriving[c], 1e-3f * (arriving[c] + 1e-3f));
  }
}

TEST(LightModesInPictures, GlossySurfacesMirrorADiffuseSkyItself) {
  // The box is of metal and all that is seen: what it shows of the sky is as if nothing were kept or baked.
  const ModeBake diffuse = few({LightMode::realtime, LightMode::diffuse});
  scene::Scene scene = diffuse.scene;
  scene.materials[1].metallic = 1;
  scene.materials[1].specular_roughness = 0.15f;
  trace::RenderParams params = from_above(16);
  params.camera.world = glm::inverse(glm::lookAt(vec3(1.5f, 2.5f, 2), vec3(0, 1, 0), vec3(0, 1, 0)));
  params.camera.camera.yfov = 0.12f;
  const trace::PathTracer tracer(scene);
  const auto sky_of = [&](const probes::ProbeSet& set) {
    const auto lookup = probes::make_lookup(probes::LookupSpec(), set, tracer);
    trace::RenderState state;
    tracer.render_with(*lookup, params, state);
    return state.groups[1];
  };
  trace::RenderState truth;
  params.path.max_depth = 1;
  tracer.render(params, truth);
  params.path.max_depth = 8;
  for (const probes::ProbeSet* set : {&diffuse.set, &sky_baked_into_few().set}) {
    const Difference found = compared(sky_of(*set), truth.groups[1], 1);
    for (glm::length_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(found.ratio[c], 1, 0.01) << c;
      EXPECT_LT(found.of_blocks[c], 0.02) << c;
    }
  }
}

TEST(LightModesInPictures, OfASessionHoldAsLongAsSurroundingsAndPoseDo) {
  const ModeBake& bake = sky_baked_into_few();
  transport::RelightParams params;
  params.transport.directions = 256;
  params.records = {.points = 512, .rays = 256, .baked = {1}};
  transport::RelightSession session(bake.source, scene::places_of(bake.set.probes), params);
  scene::LightingState state = session.lighting();
  session.update(state);
  probes::ProbeSet set = transport::lookup_set(session);
  const std::vector<std::string> sky = {"sky"};
  const auto light_at = [&](std::size_t i) { return vec3(set.surface->light[i][3]); };
  // The record that gets most of the sky
  std::size_t open = 0;
  for (std::size_t i = 0; i < set.surface->points.size(); ++i) {
    if (luminance(vec3(session.kept_direct(0).light[i][3])) >
        luminance(vec3(session.kept_direct(0).light[open][3])))
      open = i;
  }
  const auto expect_kept = [&](bool kept) {
    transport::refresh(set, session);
    EXPECT_EQ(probes::mirrored_groups(set), kept ? sky : std::vector<std::string>());
    const vec3 direct = session.kept_direct(0).light[open][3], reflected = session.record_light()[open][3];
    const vec3 expected = reflected + (kept ? state.group_scales[1] * direct : vec3(0));
    for (glm::length_t c = 0; c < 3; ++c)
      EXPECT_NEAR(light_at(open)[c], expected[c], 1e-3f * max_component(expected));
  };
  expect_kept(true);
  state.lights[0].intensity = 5;
  session.update(state);
  expect_kept(true);
  state.environment_rotation = 0.5f;
  session.update(state);
  expect_kept(false);
  state.environment_rotation = 0;
  state.group_scales[1] = vec3(0.5f, 1, 2);
  session.update(state);
  expect_kept(true);
  state.time = 0.5f;
  session.update(state);
  expect_kept(false);
  // A bake of now leaves out what does not hold
  const auto baked = [&] { return transport::baked_set(session, bake.source.light_groups(), {}); };
  EXPECT_TRUE(baked().surface->direct.empty());
  state.time = 0;
  session.update(state);
  EXPECT_EQ(probes::mirrored_groups(baked()), sky);
}

TEST(LightModesInPictures, BakesAreTheSameBitsForAnyNumberOfThreads) {
  const auto bytes = [](int threads) {
    set_thread_count(threads);
    const ModeBake bake = few({LightMode::baked, LightMode::baked}, 1024, 256);
    return probes::probes_to_binary(bake.set);
  };
  const auto one = bytes(1), two = bytes(2);
  set_thread_count(0);
  EXPECT_TRUE(one == two);
}

TEST(LightModesInPictures, BakedLightNeedsRecords) {
  probes::ProbeSet set = sky_baked_into_few().set;
  set.surface.reset();
  const std::vector<LightMode> modes = {LightMode::realtime, LightMode::baked};
  EXPECT_THROW(bake::set_light_modes(sky_baked_into_few().source, set, modes), Error);
  EXPECT_THROW(bake::set_light_modes(sky_baked_into_few().source, set, std::span(modes).first(1)), Error);
}

TEST(LightModesInPictures, AreKeptForEveryGroup) {
  probes::ProbeSet set = sky_baked_into_few().set;
  for (const std::vector<LightMode>& modes : {std::vector{LightMode::mixed, LightMode::realtime},
                                              std::vector{LightMode::realtime, LightMode::mixed}}) {
    bake::set_light_modes(sky_baked_into_few().source, set, modes);
    EXPECT_EQ(bake::light_modes(set), modes);
  }
}

TEST(LightModesInPictures, OfAFileThatHoldsOtherLightAreTold) {
  scene::Scene scene = open_ground();
  const probes::ProbeSet& set = sky_baked_into_few().set;
  EXPECT_EQ(bake::mode_difference(set, scene), "") << "who asks for nothing takes what the file has";
  scene::set_light_mode(scene, "sky", LightMode::baked);
  scene::set_light_mode(scene, "lamp", LightMode::mixed);
  EXPECT_EQ(bake::mode_difference(set, scene), "") << "mixed groups hold what realtime ones do";
  scene::set_light_mode(scene, "sky", LightMode::mixed);
  EXPECT_EQ(bake::mode_difference(set, scene), "") << "direct light that is kept may be left unused";
  scene::set_light_mode(scene, "lamp", LightMode::baked);
  EXPECT_EQ(bake::mode_difference(set, scene), "light group \"lamp\" as realtime, asked for as baked");
  scene::set_light_mode(scene, "lamp", LightMode::diffuse);
  EXPECT_EQ(bake::mode_difference(set, scene), "light group \"lamp\" as realtime, asked for as diffuse");
}

TEST(LightModesInPictures, ThatTheSceneAsksForAreThoseOfTheFileThen) {
  scene::Scene scene = open_ground();
  probes::ProbeSet set = sky_baked().set;
  bake::adopt_modes(set, scene);
  EXPECT_EQ(set, sky_baked().set) << "who asks for nothing takes what the file has";
  scene::set_light_mode(scene, "sky", LightMode::realtime);
  bake::adopt_modes(set, scene);
  EXPECT_EQ(set.light_groups[1].mode, LightMode::realtime);
  const trace::RenderState with = looked_up(scene, set, 8);
  const Difference all = compared(with.color, truth_of_ground().color, 1);
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(all.ratio[c], 1, 0.02) << c;
  EXPECT_GT(mean(with.groups[1]), mean(looked_up_of_ground().groups[1]) + 0.01f)
      << "the sky is sampled again";
}

TEST(LightModesInPictures, SharpShadowsThatWillBlurAreToldOf) {
  scene::Scene scene = open_ground();
  EXPECT_TRUE(bake::blurred_shadows(scene).empty());
  scene::set_light_mode(scene, "sky", LightMode::baked);
  scene::set_light_mode(scene, "lamp", LightMode::mixed);
  EXPECT_TRUE(bake::blurred_shadows(scene).empty());
  scene::set_light_mode(scene, "lamp", LightMode::baked);
  ASSERT_EQ(bake::blurred_shadows(scene).size(), 1u);
  scene.lights[0].type = scene::LightType::sphere;
  EXPECT_TRUE(bake::blurred_shadows(scene).empty());
}

}  // namespace
}  // namespace ssphh::test
