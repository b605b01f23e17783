/// Rectangles and discs against closed forms of their irradiance, by samples, by rays and by the formula that
/// light transport asks.

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/shading/mesh_view.h>

#include "light_scenes.h"

namespace ssphh::shading::test {
namespace {

using scene::LightType;
using ssphh::test::mean_is;
using ssphh::test::Samples;

constexpr double radiance = 3;

/// A rectangle of 1.2 × 0.8 m, its width along x, 1.5 m above the floor, shining down.
scene::Scene rectangle_above() {
  scene::Scene s;
  scene::Light& lamp = add_light(s, LightType::rectangle, {0.3f, 1.5f, -0.2f});
  lamp.size = {1.2f, 0.8f}, lamp.intensity = static_cast<float>(radiance);
  return s;
}

scene::Scene disc_above(float radius, float height, float aside) {
  scene::Scene s;
  scene::Light& lamp = add_light(s, LightType::disc, {aside, height, 0});
  lamp.radius = radius, lamp.intensity = static_cast<float>(radiance);
  return s;
}

/// Form factor of a rectangle that is seen from below one of its corners, `height` away, with sides a and b:
/// from a plane parallel to it, and from one that faces along a (Howell, B-3 and B-4 with c the height).
double parallel_corner(double a, double b, double height) {
  const double x = a / height, y = b / height, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * pi_d);
}
double upright_corner(double a, double b, double height) {
  const double r = std::sqrt(height * height + a * a);
  return (std::atan(b / height) - height / r * std::atan(b / r)) / (2 * pi_d);
}

/// Howell, B-12: a plane parallel to a disc, `aside` from its axis.
double disc_factor(double radius, double height, double aside) {
  if (aside == 0) return radius * radius / (radius * radius + height * height);
  const double h = height / aside, r = radius / aside, z = 1 + h * h + r * r;
  return 0.5 * (1 - (1 + h * h - r * r) / std::sqrt(z * z - 4 * r * r));
}

/// What uniform rays find.
Samples by_rays(const LightSet& lights, const vec3& x, const vec3& normal) {
  Pcg32 random(12);
  Samples samples;
  for (int n = 0; n < 200000; ++n) {
    const vec3 d = sample_uniform_sphere(random.uniform2());
    double sum = 0;
    lights.intersect_lamps(x, d, 1e9f, [&](const EmitterHit& hit) {
      sum += static_cast<double>(hit.radiance.x * glm::max(glm::dot(d, normal), 0.0f) * 4 * pi);
    });
    samples.add(sum);
  }
  return samples;
}

void expect_irradiance(const scene::Scene& s, const vec3& x, const vec3& normal, double exact,
                       double tolerance) {
  const LightSet lights = make_lights(s);
  ASSERT_EQ(lights.emitter_count(), 1);
  const auto view = lights.view_mesh(0, x, normal);
  ASSERT_TRUE(view);
  EXPECT_NEAR(static_cast<double>(view->irradiance().x), exact, tolerance * exact);
  EXPECT_TRUE(mean_is(irradiance(lights, x, normal), exact, {1e-3, 8}, tolerance * exact));
  EXPECT_TRUE(mean_is(by_rays(lights, x, normal), exact, {1e-3, 8}, tolerance * exact));
}

TEST(AreaLamp, ARectangleGivesItsFormFactorToAPlaneParallelToIt) {
  // Corners at x −0.3 and 0.9, z −0.6 and 0.2 about the origin: four rectangles with a corner above it.
  double factor = 0;
  for (const double a : {0.3, 0.9})
    for (const double b : {0.6, 0.2}) factor += parallel_corner(a, b, 1.5);
  expect_irradiance(rectangle_above(), vec3(0), up, pi_d * radiance * factor, 1e-5);
}

TEST(AreaLamp, ARectangleGivesItsFormFactorToAPlaneAcrossIt) {
  // What faces +x sees the part at x > 0.
  double factor = 0;
  for (const double b : {0.6, 0.2}) factor += upright_corner(0.9, b, 1.5);
  expect_irradiance(rectangle_above(), vec3(0), {1, 0, 0}, pi_d * radiance * factor, 1e-5);
}

TEST(AreaLamp, ADiscGivesItsFormFactor) {
  // Its polygon of 34 corners has the disc's area: closer than half a radius the difference would show.
  expect_irradiance(disc_above(0.4f, 1, 0), vec3(0), up, pi_d * radiance * disc_factor(0.4, 1, 0), 1e-4);
  expect_irradiance(disc_above(0.4f, 1, 0.7f), vec3(0), up, pi_d * radiance * disc_factor(0.4, 1, 0.7), 1e-4);
}

TEST(AreaLamp, ShinesFromOneSideAlone) {
  for (const scene::Scene& s : {rectangle_above(), disc_above(0.4f, 1, 0.2f)}) {
    const LightSet lights = make_lights(s);
    const vec3 above(0.3f, 4, 0);
    EXPECT_EQ(irradiance(lights, above, -up, 100).mean(), 0);
    EXPECT_EQ(by_rays(lights, above, -up).mean(), 0);
    EXPECT_EQ(lights.view_mesh(0, above, -up)->irradiance(), vec3(0));
  }
}

TEST(AreaLamp, SendsOutPiTimesAreaTimesRadianceInPhotons) {
  for (const scene::Scene& s : {rectangle_above(), disc_above(0.4f, 1, 0.2f)}) {
    const LightSet lights = make_lights(s);
    const scene::Light& lamp = s.lights[0];
    const double area = lamp.type == LightType::disc ? pi_d * 0.16 : 0.96;
    EXPECT_NEAR(static_cast<double>(scene::lamp_area(lamp)), area, 1e-6);
    EXPECT_NEAR(static_cast<double>(lights.flux(0, 1)), pi_d * area * radiance, 1e-4);
    Pcg32 random(4);
    Samples power;
    const vec3 middle = vec3(s.nodes[0].local.translation);
    for (int i = 0; i < 2000; ++i) {
      const auto photon = lights.emit(0, random.uniform2(), random.uniform2(), vec3(0), 1);
      ASSERT_TRUE(photon);
      power.add(static_cast<double>(photon->photon.power.x));
      EXPECT_LT(photon->photon.direction.y, 0);
      EXPECT_EQ(photon->normal, -up);
      EXPECT_NEAR(photon->photon.origin.y, middle.y, 1e-6f);
      EXPECT_LT(glm::distance(photon->photon.origin, middle), scene::lamp_reach(lamp) * 1.0001f);
    }
    EXPECT_TRUE(mean_is(power, pi_d * area * radiance, {1e-3, 2}, 1e-4));
  }
}

TEST(AreaLamp, IsNotScaledMirroredNorShearedByItsNode) {
  const mat4 world = scene::world_matrices(rectangle_above())[0];
  const mat3 scaled(3, 0, 0, 0, 3, 0, 0, 0, 3), mirrored(-2, 0, 0, 0, 0.5f, 0, 0, 0, 4),
      sheared(1, 0, 0, 0.7f, 1, 0, 0, 0, 1);
  for (const mat3& node : {scaled, mirrored, sheared}) {
    const mat4 pose = scene::area_lamp_pose(world * mat4(node));
    EXPECT_NEAR(glm::determinant(mat3(pose)), 1, 1e-5f);
    EXPECT_LT(glm::distance(vec3(pose[2]), vec3(world[2])), 1e-6f);
    EXPECT_EQ(pose[3], world[3]);
    EXPECT_NEAR(glm::dot(vec3(pose[1]), vec3(world[1])), node == sheared ? 1 / std::sqrt(1.49f) : 1, 1e-5f);
  }
  EXPECT_EQ(scene::area_lamp_pose(mat4(0))[2], vec4(0, 0, 1, 0)) << "a node without extent";
}

TEST(AreaLamp, IsThatOfTheMeshesThatStandForIt) {
  scene::Scene both = rectangle_above();
  add_light(both, LightType::disc, {-1, 2, 0.5f}, {0.3f, -1, 0}).radius = 0.3f;
  both.lights[1].color = {0.5f, 2, 1};
  const scene::Scene meshes = scene::area_lamps_as_meshes(both, 0);
  EXPECT_TRUE(meshes.lights.empty());
  EXPECT_EQ(scene::light_groups(meshes), scene::light_groups(both));
  const LightSet lamps = make_lights(both), panels = make_lights(meshes);
  ASSERT_EQ(lamps.emitter_count(), panels.emitter_count());
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(lamps.flux(i, 1), panels.flux(i, 1));
    const vec3 x(0.4f, 0, 0.1f);
    EXPECT_EQ(lamps.view_mesh(i, x, up)->irradiance(), panels.view_mesh(i, x, up)->irradiance());
    EXPECT_EQ(lamps.emitter(i).group, panels.emitter(i).group);
  }
}

TEST(AreaLamp, FollowsItsStateAndKeepsWhatStands) {
  const scene::Scene s = rectangle_above();
  const std::vector<mat4> world = scene::world_matrices(s);
  const LightSet base(s, world);
  std::vector<scene::LightState> states = scene::lighting_at(s, 0).lights;
  states[0].world[3] = vec4(5, 3, 1, 1), states[0].intensity = 6;
  const LightSet moved(base, world, states);
  EXPECT_NEAR(moved.flux(0, 1), 2 * base.flux(0, 1), 1e-4f);
  EXPECT_NEAR(moved.emitter(0).extent.center().x, 5, 1e-6f);
  states[0].intensity = 0;
  EXPECT_TRUE(LightSet(base, world, states).empty());
}

TEST(AreaLamp, TurnsTheShortestWayWhenItIsAimed) {
  const mat4 world = scene::world_matrices(rectangle_above())[0];
  // Across the plane of directions level with +z, where a frame built around a direction alone would spin.
  mat4 pose = scene::area_lamp_pose(world);
  for (int i = 0; i <= 100; ++i) {
    const float angle = 0.02f * static_cast<float>(i) - 1;
    const vec3 to(0.5f, -std::cos(angle), std::sin(angle));
    const mat4 next = scene::aimed_area_lamp(pose, to);
    EXPECT_LT(glm::distance(-vec3(next[2]), glm::normalize(to)), 1e-5f);
    if (i > 0) {
      EXPECT_LT(glm::distance(vec3(next[0]), vec3(pose[0])), 0.05f) << i;
    }
    pose = next;
  }
  const mat4 back = scene::aimed_area_lamp(world, vec3(world[2]));
  EXPECT_LT(glm::distance(vec3(back[2]), -vec3(world[2])), 1e-5f) << "half a turn";
}

}  // namespace
}  // namespace ssphh::shading::test
