/// How far and in how many steps DDGI moves its probes.

#include "relocate.h"

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "ray_source.h"
#include "triangle_source.h"

namespace ssphh::methods::ddgi {
namespace {

using test::RaySource;
using test::surface_at;
using test::TriangleSource;

/// A single probe at the origin whose cell is 1 m wide, in a closed room of 6 m.
struct Cell {
  scene::Scene scene;
  DdgiField field{ProbeGrid{}};
  std::vector<std::uint8_t> fresh{0};

  Cell() {
    scene.nodes.emplace_back();
    add(scene::flipped(scene::make_box(vec3(-3), vec3(3))));
  }
  void add(scene::Mesh mesh) {
    scene.instances.push_back({static_cast<int>(scene.meshes.size()), 0, -1, {}});
    scene.meshes.push_back(std::move(mesh));
  }
  std::size_t relocate(int steps, bool move = true) {
    const TriangleSource source(scene);
    return ddgi::relocate(field, rays::PosedWorld(source, 0), steps, move, fresh);
  }
  float x() const { return field.position[0].x; }
};

TEST(DdgiRelocate, LeavesABodyByItsNearestSideAndHalfTheClearance) {
  Cell cell;
  cell.add(scene::make_box({-0.6f, -2, -2}, {0.2f, 2, 2}));
  EXPECT_EQ(cell.relocate(1), 2 * 32u) << "rays: before, and after each step";
  // The nearest of 32 rays stands up to 18° off the wall's normal.
  EXPECT_GT(cell.x(), 0.2f + 0.04f);
  EXPECT_LT(glm::length(cell.field.position[0]), (0.2f + 0.05f) / 0.95f);
  EXPECT_EQ(cell.field.active[0], 1);
  EXPECT_EQ(cell.fresh[0], 0) << "it was awake before";
}

TEST(DdgiRelocate, GoesNoFartherThanNineTwentiethsOfTheSpacingAndSleepsInside) {
  for (const bool near : {true, false}) {
    Cell cell;
    cell.add(scene::make_box({-2, -2, -2}, {near ? 0.37f : 0.42f, 2, 2}));
    cell.relocate(16);
    EXPECT_EQ(cell.field.active[0], near ? 1 : 0);
    EXPECT_EQ(cell.field.position[0] == vec3(0), !near);
  }
}

TEST(DdgiRelocate, WakesAProbeThatTheBodyLeaves) {
  Cell cell;
  const scene::Scene free = cell.scene;
  cell.add(scene::make_box(vec3(-2), vec3(2)));
  cell.relocate(2);
  EXPECT_EQ(cell.field.active[0], 0);
  EXPECT_EQ(cell.fresh[0], 0);
  cell.scene = free;
  cell.relocate(2);
  EXPECT_EQ(cell.field.active[0], 1);
  EXPECT_EQ(cell.fresh[0], 1);
}

TEST(DdgiRelocate, TakesAsManyStepsAsItIsGivenAndGoesHomeWhenTheWayIsFree) {
  // A sheet 0.05 m away, within the clearance of 0.1 m: off it by 0.1 m; and home once it has gone.
  Cell cell;
  const scene::Scene free = cell.scene;
  cell.add(scene::make_quad({-0.05f, -2, 2}, {0, 0, -4}, {0, 4, 0}));
  EXPECT_EQ(cell.relocate(0), 32u);
  EXPECT_EQ(cell.field.position[0], vec3(0));
  EXPECT_EQ(cell.relocate(3, false), 32u) << "not to be moved";
  EXPECT_EQ(cell.field.position[0], vec3(0));
  cell.relocate(1);
  EXPECT_NEAR(glm::length(cell.field.position[0]), 0.1f, 1e-5f);
  EXPECT_GT(cell.x(), 0);
  cell.scene = free;
  cell.relocate(1);
  EXPECT_EQ(cell.field.position[0], vec3(0));
}

TEST(DdgiRelocate, AQuarterOfBacksIsNotInside) {
  // A cap around +z of which backs are seen; the rest is a room.
  for (const float share : {0.22f, 0.28f}) {
    const RaySource source([&](const vec3&, const vec3& d) { return surface_at(1, d, d.z > 1 - 2 * share); });
    DdgiField field{ProbeGrid{}};
    std::vector<std::uint8_t> fresh{0};
    relocate(field, rays::PosedWorld(source, 0), 1, false, fresh);
    EXPECT_EQ(field.active[0], share < 0.25f ? 1 : 0);
  }
}

}  // namespace
}  // namespace ssphh::methods::ddgi
