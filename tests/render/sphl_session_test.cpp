/// SPHLs that shine while time goes on: a session that follows them, against one that is made anew, and
/// against path tracing.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/sh/project.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "lit_session.h"

namespace ssphh {
namespace {

using glm::dvec3;

/// The vault with the SPHL alone.
scene::Scene fire_alone() {
  scene::Scene scene = scene::make_builtin("torch");
  for (scene::Material& material : scene.materials) material.emission = vec3(0);
  scene.animations.clear();
  return scene;
}

std::vector<scene::ProbePlace> places() {
  return {{"a", {-2.3f, 1.6f, 1.5f}, 0.1f}, {"b", {-0.4f, 1.7f, 0.2f}, 0.1f}, {"c", {2, 1.8f, -1.3f}, 0.1f}};
}

/// Coarse: two sessions are compared, neither with a truth.
transport::RelightParams coarse() {
  transport::RelightParams params;
  params.transport = {.directions = 96, .surfel_size = 0.4f, .link_rays = 32};
  return params;
}

TEST(SphlSession, FollowsTheFramesAsOneMadeAnewHasThem) {
  const scene::Scene scene = fire_alone();
  const trace::TransportScene source(scene);
  EXPECT_EQ(source.duration(), 2) << "the fire";
  test::LitSession session(source, places(), coarse());
  session.update();
  const std::vector<sh::RadianceSh> before = session.reflected();
  for (const float time : {0.3f, 1.7f, 4.3f}) {
    session.update(rays::lighting_at(source, time));
    test::LitSession anew(source, places(), coarse());
    anew.update(rays::lighting_at(source, time));
    for (std::size_t i = 0; i < before.size(); ++i) {
      const float level = anew.reflected()[i][0].x;
      EXPECT_GT(level, 0);
      EXPECT_GT(std::abs(before[i][0].x / level - 1), 0.01f) << "it flickers";
      for (std::size_t k = 0; k < before[i].values.size(); ++k) {
        const vec3 off = session.reflected()[i].values[k] - anew.reflected()[i].values[k];
        EXPECT_LT(max_component(glm::abs(off)), 2e-3f * level) << i << " " << k;
      }
    }
  }
}

TEST(SphlSession, LightsProbesAsPathTracingDoes) {
  const scene::Scene scene = fire_alone();
  const trace::TransportScene source(scene);
  test::LitSession session(source, places());
  const float time = 0.8f;
  session.update(rays::lighting_at(source, time));
  const trace::PathTracer tracer(scene, time);
  for (std::size_t i = 0; i < places().size(); ++i) {
    rays::CubeRequest request;
    request.position = places()[i].position;
    request.face_size = 16, request.path.spp = 64;  // which leave a noise of 0.3 %
    const auto traced = tracer.incident_radiance(request, {});
    dvec3 mean(0);
    for (const rays::GroupRadiance& group : traced) {
      sh::CubeFaces faces;
      for (std::size_t f = 0; f < 6; ++f) faces[f] = group.reflected.faces[f].pixels;
      mean += dvec3(sh::project_cube(0, request.face_size, faces, group.reflected.faces[0].channels)[0]);
    }
    mean /= std::sqrt(4 * static_cast<double>(pi));
    const vec3 looked_up = session.reflected()[i][0] / std::sqrt(4 * pi);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(looked_up[c]) / mean[c], 1, 0.03) << i << " " << c;
  }
}

}  // namespace
}  // namespace ssphh
