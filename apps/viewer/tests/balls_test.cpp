#include "model/balls.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/reconstruct.h>

namespace ssphh::viewer {
namespace {

TEST(Balls, MeshIsAClosedUnitSphereSeenFromOutside) {
  const BallMesh mesh = make_ball(3);
  EXPECT_EQ(mesh.triangles.size(), 8u * 64);
  EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size(), 3 * mesh.triangles.size() / 2 + 2) << "Euler";
  std::map<std::pair<unsigned, unsigned>, int> edges;
  double volume = 0;
  for (const uvec3& t : mesh.triangles) {
    ++edges[{t.x, t.y}], ++edges[{t.y, t.z}], ++edges[{t.z, t.x}];
    volume += static_cast<double>(
                  glm::dot(mesh.vertices[t.x], glm::cross(mesh.vertices[t.y], mesh.vertices[t.z]))) /
              6;
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_NEAR(volume, 4 * pi_d / 3, 0.1);
  for (const vec3& v : mesh.vertices) EXPECT_NEAR(glm::length(v), 1, 1e-6f);
}

/// One probe whose own light is the SH of a smooth function, with a hierarchy that doubles it.
probes::ProbeSet one_probe() {
  probes::ProbeSet set;
  set.degree = 3;
  set.light_groups.push_back({"all"});
  probes::Probe probe;
  sh::RadianceSh light(3);
  for (int k = 0; k < 16; ++k) light[k] = vec3(0.1f, 0.2f, -0.1f) / static_cast<float>(k + 1);
  light[0] = vec3(5, 4, 3);
  probe.groups.push_back({{}, light});
  set.probes.push_back(probe);
  probes::merge_groups(set);
  return set;
}

TEST(Balls, ShowTheValueOfTheFunctionAtEachVertex) {
  probes::ProbeSet set = one_probe();
  const BallShader shader(make_ball(1));
  std::vector<vec3> out(shader.mesh().vertices.size());
  const auto expect = [&](Ball ball, const auto& value) {
    shader.shade(set, 0, ball, out);
    for (std::size_t v = 0; v < out.size(); ++v)
      EXPECT_LT(glm::distance(out[v], value(shader.mesh().vertices[v])), 1e-5f) << name_of(ball);
  };
  const sh::RadianceSh self = set.probes[0].self;
  expect(Ball::radiance, [&](const vec3& n) { return sh::eval(self, n); });
  expect(Ball::irradiance, [&](const vec3& n) { return sh::irradiance(self, n) / pi; });
  expect(Ball::neighbor, [](const vec3&) { return vec3(0); });
  set.hierarchy.emplace();
  set.hierarchy->neighbor.push_back(self);
  set.hierarchy->sum.push_back(self);
  set.hierarchy->sum[0] *= vec3(2);
  expect(Ball::self, [&](const vec3& n) { return sh::eval(self, n); });
  expect(Ball::neighbor, [&](const vec3& n) { return sh::eval(self, n); });
  expect(Ball::sum, [&](const vec3& n) { return 2.0f * sh::eval(self, n); });
}

TEST(Balls, AreNeverDarkerThanBlack) {
  probes::ProbeSet set = one_probe();
  sh::RadianceSh& light = set.probes[0].self;
  light[0] = vec3(-5, 0, 5), light[1] = vec3(0), light[2] = vec3(1);
  const BallShader shader(make_ball(0));
  std::vector<vec3> out(6);
  shader.shade(set, 0, Ball::self, out);
  for (std::size_t v = 0; v < 6; ++v)
    EXPECT_EQ(out[v], glm::max(sh::eval(light, shader.mesh().vertices[v]), vec3(0)));
  EXPECT_EQ(out[0].x, 0);
  set.probes[0].self = {};
  out.assign(6, vec3(7));
  shader.shade(set, 0, Ball::self, out);
  EXPECT_EQ(out, std::vector<vec3>(6, vec3(0))) << "a probe without light";
}

TEST(Balls, HaveASixthOfTheProbesDistanceAtMostTwelveCentimetresOrAFortieth) {
  const auto size = [](float spacing, int count) {
    probes::ProbeSet set;
    for (int i = 0; i < count; ++i)
      set.probes.emplace_back().position = {spacing * static_cast<float>(i), 0, 0};
    return default_ball_size(set);
  };
  EXPECT_FLOAT_EQ(size(0.3f, 4), 0.05f);
  EXPECT_FLOAT_EQ(size(0.3f, 2), 0.05f);
  EXPECT_FLOAT_EQ(size(2, 4), 0.12f);
  EXPECT_FLOAT_EQ(size(8, 4), 0.4f) << "in a hall";
  EXPECT_FLOAT_EQ(size(0.0006f, 4), 0.0001f) << "of a scene as large as a coin";
  EXPECT_FLOAT_EQ(size(800, 4), 40) << "in millimetres taken for metres";
  EXPECT_FLOAT_EQ(size(0.3f, 1), 0.12f);
}

TEST(Balls, AreCoarserTheMoreThereAre) {
  EXPECT_EQ(ball_levels(1), 4);
  EXPECT_EQ(ball_levels(64), 4);
  EXPECT_EQ(ball_levels(65), 3);
  EXPECT_EQ(ball_levels(512), 3);
  EXPECT_EQ(ball_levels(513), 2);
}

}  // namespace
}  // namespace ssphh::viewer
