/// Where ddgi probes stand, where their rays go, and what these bring.

#include "rays.h"

#include <gtest/gtest.h>

#include <ssphh/core/octahedral.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/scene.h>

#include "error_message.h"
#include "given_light.h"
#include "ray_source.h"
#include "reach.h"
#include "triangle_source.h"

namespace ssphh::methods::ddgi {
namespace {

using test::message_of;
using test::RaySource;
using test::surface_at;

TEST(DdgiGrid, CellsAreAtMostAsWideAsAsked) {
  const scene::Bounds box{vec3(1, 2, 3), vec3(5, 4, 4)};
  const ProbeGrid one = make_grid(box, 1, 0, 100);
  EXPECT_EQ(one.count, glm::ivec3(4, 2, 1));
  EXPECT_EQ(one.spacing, vec3(1));
  EXPECT_EQ(one.first, vec3(1.5f, 2.5f, 3.5f));
  const ProbeGrid finer = make_grid(box, 0.9f, 0, 100);
  EXPECT_EQ(finer.count, glm::ivec3(5, 3, 2));
  EXPECT_EQ(finer.spacing, vec3(0.8f, 2 / 3.0f, 0.5f));
  EXPECT_EQ(finer.least_spacing(), 0.5f);
  EXPECT_EQ(make_grid(box, 50, 0, 100).count, glm::ivec3(1));
  // A thousandth of a cell is rounding.
  EXPECT_EQ(make_grid(box, 0.998f, 0, 100).count, glm::ivec3(5, 3, 2));
  EXPECT_EQ(make_grid(box, 0.9999f, 0, 100).count, glm::ivec3(4, 2, 1));
  const scene::Bounds flat{vec3(0), vec3(4, 0, 4)};
  EXPECT_EQ(make_grid(flat, 1, 0, 100).count, glm::ivec3(4, 1, 4));
  EXPECT_EQ(make_grid(flat, 1, 0, 100).spacing.y, 1e-3f);
}

TEST(DdgiGrid, WithoutASpacingItHasTheWidestCellsThatGiveAsMany) {
  const scene::Bounds box{vec3(0), vec3(4, 2, 1)};
  EXPECT_EQ(make_grid(box, 0, 1, 100).count, glm::ivec3(1));
  EXPECT_EQ(make_grid(box, 0, 2, 100).count, glm::ivec3(2, 1, 1));
  EXPECT_EQ(make_grid(box, 0, 8, 100).count, glm::ivec3(4, 2, 1));
  EXPECT_EQ(make_grid(box, 0, 64, 100).count, glm::ivec3(8, 4, 2));
  const ProbeGrid nine = make_grid(box, 0, 9, 100);
  EXPECT_EQ(nine.count, glm::ivec3(5, 2, 1)) << "the next edge at which a side is divided anew";
}

TEST(DdgiGrid, IndexesXFastestAndRefusesTooManyProbes) {
  const ProbeGrid grid{{1, 2, 3}, {0.5f, 1, 2}, {4, 3, 2}};
  EXPECT_EQ(grid.size(), 24);
  for (int i = 0; i < grid.size(); ++i) EXPECT_EQ(grid.index(grid.cell(i)), i);
  EXPECT_EQ(grid.cell(23), glm::ivec3(3, 2, 1));
  EXPECT_EQ(grid.cell(5), glm::ivec3(1, 1, 0));
  EXPECT_EQ(grid.position(17), vec3(1.5f, 3, 5));
  const scene::Bounds box{vec3(0), vec3(4, 2, 1)};
  EXPECT_EQ(make_grid(box, 1, 0, 8).size(), 8);
  EXPECT_NE(message_of([&] { make_grid(box, 1, 0, 7); }).find("8 probes are more than 7"), std::string::npos);
}

TEST(DdgiRays, AreTheFibonacciSetTurnedAnewInEachFrame) {
  constexpr int count = 32, frames = 4000;
  vec3 mean(0), squares(0), products(0);
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<vec3> d = ray_directions(count, 5, static_cast<std::uint64_t>(frame));
    ASSERT_EQ(d.size(), std::size_t{count});
    // A rotation keeps volumes, sign included.
    const auto volume = [](const vec3& a, const vec3& b, const vec3& c) {
      return glm::dot(a, glm::cross(b, c));
    };
    const float turned = volume(d[3], d[9], d[17]);
    EXPECT_NEAR(
        turned,
        volume(spherical_fibonacci(3, count), spherical_fibonacci(9, count), spherical_fibonacci(17, count)),
        1e-5f);
    mean += d[0] / float{frames}, squares += d[0] * d[0] / float{frames};
    products += vec3(d[0].x * d[0].y, d[0].y * d[0].z, d[0].z * d[0].x) / float{frames};
  }
  // Of a uniform direction: variances 1/3, 4/45 and 1/15; five deviations.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c], 0, 5 * std::sqrt(1.0f / 3 / frames));
    EXPECT_NEAR(squares[c], 1.0f / 3, 5 * std::sqrt(4.0f / 45 / frames));
    EXPECT_NEAR(products[c], 0, 5 * std::sqrt(1.0f / 15 / frames));
  }
  EXPECT_EQ(ray_directions(count, 5, 3), ray_directions(count, 5, 3));
  EXPECT_NE(ray_directions(count, 6, 3), ray_directions(count, 5, 3));
}

/// A room of walls at z = ±1 and dark ones at x = ±1, none at y; probes at the origin, asleep, and at x = ½.
struct Traced {
  RaySource source{[](const vec3& p, const vec3& d) {
    if (d.y != 0) return rays::RayHit{};
    const bool along_z = d.z != 0;
    rays::RayHit hit = surface_at(along_z ? 1.0f : 1 - d.x * p.x, d);
    if (along_z) hit.albedo = {0.5f, 0.25f, 1};
    return hit;
  }};
  DdgiField field{ProbeGrid{vec3(0), vec3(1), {2, 1, 1}}};
  test::GivenLight light;
  const std::vector<vec3> directions{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};

  Traced() {
    field.active[0] = 0;
    field.position[1] = {0.5f, 0, 0};
    field.visibility = false;
    light.at = [](int group, const rays::SurfacePoint& p) {
      return group == 0 ? vec3(1, 2, 3) * (2 + p.position.z) : vec3(p.position.x, 0, 7);
    };
  }
  std::vector<ProbeRay> trace() {
    return trace_probes(field, rays::PosedWorld(source, 0), light, std::vector<vec3>{vec3(1), vec3(2, 0, 0)},
                        directions, {});
  }
};

TEST(DdgiRays, BringWhatLitSurfacesScatter) {
  Traced traced;
  const std::vector<ProbeRay> rays = traced.trace();
  ASSERT_EQ(rays.size(), 4u) << "of the one that is awake";
  const auto expect = [](const vec3& found, const vec3& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-5f) << "channel " << c;
  };
  // ρ / π times the first group's light and twice the second's red.
  const vec3 albedo(0.5f, 0.25f, 1);
  expect(rays[0].radiance, albedo / pi * (3.0f * vec3(1, 2, 3) + vec3(1, 0, 0)));
  expect(rays[3].radiance, albedo / pi * (1.0f * vec3(1, 2, 3) + vec3(1, 0, 0)));
  EXPECT_EQ(rays[0].distance, 1);
  EXPECT_EQ(rays[1].radiance, vec3(0));
  EXPECT_TRUE(std::isinf(rays[1].distance));
  EXPECT_EQ(rays[2].radiance, vec3(0)) << "a black wall";
  EXPECT_EQ(rays[2].distance, 0.5f);
}

TEST(DdgiRays, AddTheFieldsOwnLightSeenFromTheProbe) {
  Traced traced;
  traced.light.at = [](int, const rays::SurfacePoint&) { return vec3(0); };
  // Light by the way that a surface faces: of the wall ahead, which faces −z.
  for (int t = 0; t < DdgiField::irradiance_texels; ++t)
    traced.field.irradiance_of(1)[t] =
        octahedral_texel(t, DdgiField::irradiance_size).z < 0 ? vec3(2, 4, 6) : vec3(0);
  const std::vector<ProbeRay> rays = traced.trace();
  const vec3 expected = vec3(0.5f, 0.25f, 1) / pi * vec3(2, 4, 6);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rays[0].radiance[c], expected[c], 1e-5f);
  EXPECT_EQ(rays[3].radiance, vec3(0));
  // The lookup's bias leads from the wall toward the probe.
  const vec3 wo(0, 0, -1);
  const vec3 lookup = traced.field.irradiance({0.5f, 0, 1}, wo, wo, wo);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(lookup[c], vec3(2, 4, 6)[c], 1e-5f);
}

/// A floor of 2 m by 2 m, and above it a plate that goes 6 m aside and comes back within a second.
scene::Scene with_shuttle() {
  scene::Scene scene;
  scene.materials.emplace_back();
  scene.meshes = {scene::make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}),
                  scene::make_quad({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1})};
  for (int i = 0; i < 2; ++i) {
    scene.meshes[i].material = 0;
    scene.nodes.emplace_back();
    scene.instances.push_back({i, i, -1, ""});
  }
  scene::AnimationChannel channel;
  channel.node = 1;
  channel.path = scene::AnimationPath::translation;
  channel.times = {0, 0.5f, 1};
  channel.values = {{0, 1, 0, 0}, {6, 1, 0, 0}, {0, 1, 0, 0}};
  scene.animations.push_back({"shuttle", {channel}});
  scene.nodes.emplace_back().local.translation = vec3(2, 3, 0);
  scene.cameras.resize(1);
  scene.cameras[0].node = 2;
  scene::validate(scene);
  return scene;
}

TEST(DdgiGrid, ReachesAsFarAsThingsDoInTheMiddleAndOneSpacingIntoTheAir) {
  const scene::Scene scene = with_shuttle();
  const test::TriangleSource source(scene);
  const ProbeGrid grid = grid_in_reach({scene, source}, 0.5f, 0, 4000, {});
  // 1024 points a pose lie within centimetres of the edges; what is open above is gone into for a spacing.
  const vec3 low = grid.first - 0.5f * grid.spacing,
             high = grid.first + grid.spacing * (vec3(grid.count) - 0.5f);
  EXPECT_NEAR(low.x, -1, 0.1f);
  EXPECT_NEAR(high.x, 6.5f, 0.1f);
  EXPECT_NEAR(low.z, -1, 0.1f);
  EXPECT_NEAR(high.z, 1, 0.1f);
  EXPECT_NEAR(low.y, 0, 0.6f);
  EXPECT_NEAR(high.y, 1.5f, 0.05f) << "the plate's height and a cell";
}

}  // namespace
}  // namespace ssphh::methods::ddgi
