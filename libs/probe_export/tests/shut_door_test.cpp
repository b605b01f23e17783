// Two rooms, one lit, the door between them shut: engines interpolate without asking what sees what, and find
// next to no light in the dark one.

#include <algorithm>

#include <ssphh/scene/builtin.h>

#include "readers.h"
#include "triangle_source.h"

namespace ssphh::probe_export {
namespace {

constexpr float half_wall = 0.075f, far = 4.075f, height = 3, depth = 2;
const vec3 lit(1, 2, 3);

/// Room A, x < 0, has light of radiance `lit` from everywhere, room B none.
probes::ProbeSet two_rooms() {
  probes::ProbeSet set;
  set.degree = 2;
  set.light_groups = {{"lamp"}};
  for (int i = 0; i < 8 * 3 * 4; ++i) {
    probes::Probe probe;
    const float x = static_cast<float>(i % 8) - 3.5f;
    probe.position = {x, 0.5f + static_cast<float>(i / 8 % 3), static_cast<float>(i / 24) - 1.5f};
    probes::GroupLight& light = probe.groups.emplace_back();
    light.reflected = sh::RadianceSh(2);
    if (x < 0) light.reflected[0] = lit * 3.544908f;  // √4π
    set.probes.push_back(probe);
  }
  probes::merge_groups(set);
  return set;
}

/// Over the walls, floor and ceiling of the room on this side, a few centimetres from the edges.
std::vector<rays::SurfacePoint> walls(float side) {
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const float s = 0.02f + 0.96f * static_cast<float>(i) / 19,
                  t = 0.02f + 0.96f * static_cast<float>(j) / 19;
      const float x = side * glm::mix(half_wall, far, s), y = height * t, z = depth * (2 * t - 1);
      points.push_back({{x, 0, z}, {0, 1, 0}});
      points.push_back({{x, height, z}, {0, -1, 0}});
      points.push_back({{x, y, -depth}, {0, 0, 1}});
      points.push_back({{x, y, depth}, {0, 0, -1}});
      points.push_back({{side * far, height * s, z}, {-side, 0, 0}});
      const bool doorway = std::abs(z) < 0.5f && height * s < 2.15f;
      points.push_back({{side * half_wall + (doorway ? 0.04f : 0.0f) * side, height * s, z}, {side, 0, 0}});
    }
  }
  return points;
}

/// Shares of what the lit room has.
struct Leak {
  float door = 0;   ///< most on the wall and the door leaf between the rooms, seen from the dark one
  float far = 0;    ///< most in the dark room a cell and more from that wall
  float mean = 0;   ///< of all its surfaces
  float least = 1;  ///< least in the lit room a cell and more from that wall
};

template <class Find>
Leak leak_of(float cell, const Find& find) {
  Leak leak;
  const std::vector<rays::SurfacePoint> dark = walls(1);
  for (const rays::SurfacePoint& p : dark) {
    const float share = max_component(find(p) / lit);
    leak.mean += share / static_cast<float>(dark.size());
    if (p.normal.x > 0) leak.door = std::max(leak.door, share);
    if (p.position.x > half_wall + 0.04f + cell) leak.far = std::max(leak.far, share);
  }
  for (const rays::SurfacePoint& p : walls(-1)) {
    if (p.position.x < -half_wall - cell) leak.least = std::min(leak.least, max_component(find(p) / lit));
  }
  return leak;
}

/// A border between cells lies where wall and leaf meet, to a 32nd of a cell or two. Floors and side walls
/// within a cell of the wall are asked for along it, where no border helps: a narrow strip of them gets light
/// from beyond, which is less the smaller the cells.
void expect_little(const Leak& leak, float spacing) {
  EXPECT_LT(leak.door, 0.06f) << spacing;
  EXPECT_LT(leak.far, 1e-3f) << spacing;
  EXPECT_LT(leak.mean, 0.05f * spacing) << spacing;
  EXPECT_GT(leak.least, 0.995f) << spacing;
}

class ShutDoor : public testing::TestWithParam<float> {
 protected:
  Exported exported(const char* target) const {
    ExportSource source{set_, source_};
    source.grid.spacing = GetParam();
    return find_target(target).write(source, "grid", {});
  }

  const test::TriangleSource source_{scene::make_builtin("two-rooms")};
  const probes::ProbeSet set_ = two_rooms();
};

TEST_P(ShutDoor, LittleLightBeyondItInThree) {
  const ThreeReader reader(exported("three"));
  const Leak leak = leak_of(GetParam(), [&](const rays::SurfacePoint& p) {
    EXPECT_TRUE(reader.holds(p.position, p.normal));
    return reader.irradiance(p.position, p.normal) / pi;
  });
  expect_little(leak, GetParam());
}

TEST_P(ShutDoor, LittleLightBeyondItInBevy) {
  const BevyReader reader(exported("bevy"));
  expect_little(
      leak_of(GetParam(), [&](const rays::SurfacePoint& p) { return reader.diffuse(p.position, p.normal); }),
      GetParam());
}

/// Objects are lit by the light at their place, which is half a cell and more before the wall.
TEST_P(ShutDoor, NextToNoLightBeyondItOnObjectsInBabylon) {
  const ObjectGridReader reader(exported("babylon"), "ssphh-babylon-grid");
  float leaked = 0, least = 1;
  for (const float side : {-1.0f, 1.0f}) {
    for (int i = 0; i < 1000; ++i) {
      const vec3 t = (vec3(i % 10, i / 10 % 10, i / 100) + 0.5f) / 10.0f;
      const vec3 at(side * glm::mix(half_wall + 0.04f + 0.5f * reader.cell().x, far, t.x), height * t.y,
                    depth * (2 * t.z - 1));
      const std::array<vec3, 9> colors = reader.colors(at);
      for (const vec3 n : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0)}) {
        const float share = max_component(babylon_diffuse(colors, n) / lit);
        if (side > 0) leaked = std::max(leaked, share);
        if (side < 0) least = std::min(least, share);
      }
    }
  }
  EXPECT_LT(leaked, 1e-3f);
  EXPECT_GT(least, 0.995f);
}

INSTANTIATE_TEST_SUITE_P(Cells, ShutDoor, testing::Values(0.5f, 0.37f, 0.21f));

}  // namespace
}  // namespace ssphh::probe_export
