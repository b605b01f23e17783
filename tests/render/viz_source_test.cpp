/// What lights the others in VIZ, and which scattering counts.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/log.h>
#include <ssphh/place/init.h>
#include <ssphh/trace/path_tracer.h>

#include "root_4pi.h"
#include "transport_fixtures.h"
#include "z_test.h"

namespace ssphh::test {
namespace {

/// coloured_room() in the dark, its SPHLs of this radius.
scene::Scene dark_room(float radius) {
  scene::Scene scene = coloured_room(vec3(0));
  for (scene::Sphl& sphl : scene.sphls) sphl.radius = radius;
  return scene;
}

probes::ProbeSet traced(const scene::Scene& scene, const bake::BakeParams& params) {
  set_log_level(LogLevel::error);  // Dark rooms are meant here.
  bake::BakeReport report;
  return bake::bake(trace::PathTracer(scene), place::init_from_scene(scene, 2), params, {}, report);
}

bake::BakeParams effort(int face, int spp, int depth) {
  bake::BakeParams params;
  params.face_size = face, params.path.spp = spp, params.path.max_depth = depth;
  return params;
}

// The flux that a sphere of intensity 1 sends out is 4π W whatever its radius; what differs is how it is seen
// from near.
TEST(VizSource, PHardlyDependsOnTheRadiusWithIntensityAndGrowsWithItsSquareWithRadiance) {
  for (const probes::VizSource source : {probes::VizSource::intensity, probes::VizSource::radiance}) {
    bake::BakeParams params = effort(12, 24, 3);
    params.viz_params.source = source;
    const probes::ProbeSet large = traced(dark_room(0.1f), params), small = traced(dark_room(0.05f), params);
    const float expected = source == probes::VizSource::intensity ? 1 : 4;
    for (std::size_t i = 0; i < large.probes.size(); ++i) {
      ASSERT_EQ(large.probes[i].edges.size(), 3u);
      ASSERT_EQ(small.probes[i].edges.size(), 3u);
      for (std::size_t e = 0; e < 3; ++e) {
        const float ratio = large.probes[i].edges[e].transfer / small.probes[i].edges[e].transfer;
        EXPECT_NEAR(ratio, expected, 0.02f * expected) << i << " " << e;
      }
    }
  }
}

// Of four pairs the pillar hides one SPHL from the other: what is left of them is what the walls scatter.
// Both radii have the same random numbers.
TEST(VizSource, PAroundAPillarChangesByLessThanTwoPercentInEachColourWhenTheRadiusIsHalved) {
  const auto pillar_room = [](float radius) {
    scene::Scene scene = dark_room(radius);
    scene.sphls.clear();
    add_body(scene, "pillar", scene::make_box({-0.15f, -1, -0.15f}, {0.15f, 1, 0.15f}), {0.8f, 0.5f, 0.3f});
    for (const vec3& at :
         {vec3(-0.6f, 0, 0), vec3(0.6f, 0.1f, 0), vec3(0, -0.2f, -0.6f), vec3(0, 0.2f, 0.6f)})
      add_sphl(scene, fmt::format("at {:g} {:g}", at.x, at.z), at, radius);
    scene::validate(scene);
    return scene;
  };
  const bake::BakeParams params = effort(16, 32, 3);
  const probes::ProbeSet large = traced(pillar_room(0.1f), params),
                         small = traced(pillar_room(0.05f), params);
  const scene::Scene room = pillar_room(0.1f);
  const trace::PathTracer tracer(room);
  int hidden = 0;
  float most = 0;
  for (std::size_t i = 0; i < large.probes.size(); ++i) {
    ASSERT_EQ(large.probes[i].edges.size(), 3u);
    ASSERT_EQ(small.probes[i].edges.size(), 3u);
    for (std::size_t e = 0; e < 3; ++e) {
      const probes::Edge &wide = large.probes[i].edges[e], &narrow = small.probes[i].edges[e];
      hidden += tracer.visible(large.probes[i].position, large.probes[wide.from].position) ? 0 : 1;
      most = std::max(most, std::abs(wide.transfer / narrow.transfer - 1));
      EXPECT_NEAR(wide.transfer / narrow.transfer, 1, 0.02f) << i << " " << e;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(wide.h[0][c] / narrow.h[0][c], 1, 0.02f) << i << " " << e << " " << c;
    }
  }
  EXPECT_EQ(hidden, 4);
  RecordProperty("largest_change", std::to_string(most));
}

TEST(VizSource, LinksKeepTheSameRule) {
  const auto edges = [](float radius, probes::VizSource source) {
    const scene::Scene scene = dark_room(radius);
    bake::TransportBakeParams params;
    params.transport = small_network();
    params.viz = true;
    params.viz_params.source = source;
    bake::TransportBakeReport report;
    return bake::bake_transport(trace::TransportScene(scene), place::init_from_scene(scene, 1), params,
                                report);
  };
  const probes::ProbeSet large = edges(0.1f, probes::VizSource::intensity),
                         small = edges(0.05f, probes::VizSource::intensity),
                         unit = edges(0.1f, probes::VizSource::radiance);
  EXPECT_EQ(large.generator.viz_source, probes::VizSource::intensity);
  EXPECT_EQ(unit.generator.viz_source, probes::VizSource::radiance);
  for (std::size_t i = 0; i < large.probes.size(); ++i) {
    for (std::size_t e = 0; e < 3; ++e) {
      const float p = large.probes[i].edges[e].transfer;
      EXPECT_NEAR(small.probes[i].edges[e].transfer, p, 0.02f * p) << i << " " << e;
      EXPECT_NEAR(unit.probes[i].edges[e].transfer, p * pi * 0.01f, 1e-5f * p) << i << " " << e;
    }
  }
}

/// A probe and an SPHL above a floor that fills the half space below.
scene::Scene above_a_floor(const scene::Material& material) {
  scene::Scene scene;
  add_body(scene, "floor", scene::make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}), vec3(0));
  scene.materials[0] = material;
  add_sphl(scene, "eye", {0, 1, 0}, 0.2f);
  add_sphl(scene, "lamp", {1, 1, 0}, 0.2f);
  scene::validate(scene);
  return scene;
}

TEST(VizPaths, OfDiffuseScatteringAloneSeeNoMirrorImages) {
  scene::Material mirror;
  mirror.base_color = vec3(0.9f), mirror.metallic = 1, mirror.specular_roughness = 0;
  const scene::Scene scene = above_a_floor(mirror);
  bake::BakeParams params = effort(32, 64, 3);
  const float with = traced(scene, params).probes[0].edges[0].transfer;
  params.viz_params.paths = rays::PathSet::diffuse;
  const float without = traced(scene, params).probes[0].edges[0].transfer;
  const auto share = [](double distance) {
    return (1 - std::sqrt(1 - 0.04 / (distance * distance))) / 2 / (pi_d * 0.04);
  };
  EXPECT_NEAR(double(without), share(1), 0.01 * share(1)) << "the sphere itself";
  // The image is as far as √5, seen at 1/√5 from the normal where a metal's Fresnel hardly differs from 0.9.
  EXPECT_NEAR(double(with - without), 0.9 * share(std::sqrt(5.0)), 0.05 * share(std::sqrt(5.0)));
}

TEST(VizPaths, OfDiffuseScatteringAloneAreAllThereAreAmongMattSurfaces) {
  const scene::Scene scene = dark_room(0.1f);
  bake::BakeParams params = effort(8, 4, 3);
  const probes::ProbeSet all = traced(scene, params);
  params.viz_params.paths = rays::PathSet::diffuse;
  const probes::ProbeSet diffuse = traced(scene, params);
  for (std::size_t i = 0; i < all.probes.size(); ++i)
    EXPECT_EQ(diffuse.probes[i].edges, all.probes[i].edges) << i;
}

// Small spheres are sampled and large ones met by rays; with bounces, shadow rays and scattered ones try to
// pass.
TEST(VizPaths, OfDiffuseScatteringAloneEndAtGlass) {
  scene::Scene scene = above_a_floor({});
  add_body(scene, "pane", scene::make_quad({0.5f, 0, -50}, {0, 0, 100}, {0, 100, 0}), vec3(1));
  scene::Material& glass = scene.materials.back();
  glass.transmission = 1, glass.specular_roughness = 0, glass.double_sided = true;
  for (const float radius : {0.2f, 0.45f}) {
    for (scene::Sphl& sphl : scene.sphls) sphl.radius = radius;
    for (const int depth : {0, 2}) {
      bake::BakeParams params = effort(16, 16, depth);
      EXPECT_EQ(traced(scene, params).probes[0].edges.size(), 1u) << radius << " " << depth;
      params.viz_params.paths = rays::PathSet::diffuse;
      EXPECT_EQ(traced(scene, params).probes[0].edges.size(), 0u) << radius << " " << depth;
    }
  }
}

}  // namespace
}  // namespace ssphh::test
