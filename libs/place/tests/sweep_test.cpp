/// Ways of moving parts: how finely they are followed, and what they come between.

#include <algorithm>
#include <set>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/place/sweep.h>
#include <ssphh/scene/builtin.h>

#include "triangle_source.h"
#include "unlit_source.h"

namespace ssphh::place {
namespace {

const scene::Bounds box{vec3(1, 2, 3), vec3(3, 3, 4)};

/// A part that grows to twice its size in four seconds while one corner of its box stays where it is: the
/// opposite one goes the box's whole diagonal, and no other goes as far. Remembers the times it was asked
/// for.
class Growing final : public test::UnlitSource {
 public:
  explicit Growing(int corner)
      : fixed_((corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y,
               (corner & 4) ? box.max.z : box.min.z) {}
  int part_count() const override { return 2; }
  const std::string& part_name(int) const override { return name_; }
  scene::Bounds part_bounds(int part) const override { return part == 0 ? scene::Bounds{} : box; }
  float duration() const override { return 4; }
  mat4 part_pose(int, float time) const override {
    times.insert(time);
    return glm::translate(mat4(1), fixed_) * glm::scale(mat4(1), vec3(1 + time / 4)) *
           glm::translate(mat4(1), -fixed_);
  }
  void intersect(int, std::span<const rays::RayQuery>, std::span<rays::RayHit>) const override {}
  void occluded(int, std::span<const rays::RayQuery>, std::span<std::uint8_t>) const override {}
  std::uint64_t rays_traced() const override { return 0; }

  mutable std::set<float> times;

 private:
  vec3 fixed_;
  std::string name_ = "growing";
};

/// The moments that are looked at until so many poses are enough: of 9, or twice and twice as many.
std::set<float> moments(int enough) {
  std::set<float> times;
  for (int count = 9;; count = std::min(2 * count, 256)) {
    for (int i = 0; i < count; ++i) times.insert(4 * static_cast<float>(i) / static_cast<float>(count - 1));
    if (count >= enough) return times;
  }
}

void expect_poses(float step, int corner, int count) {
  const Growing source(corner);
  EXPECT_TRUE(Sweep(source, step).any());
  EXPECT_EQ(source.times, moments(count)) << "corner " << corner << ", " << step << " m";
}

TEST(SweepPoses, AreSoManyThatNoCornerGoesFartherThanAStep) {
  const float way = glm::length(box.max - box.min);
  for (int corner = 0; corner < 8; ++corner) {
    expect_poses(1.001f * way / 8, corner, 9);
    expect_poses(0.999f * way / 8, corner, 18);
    expect_poses(0.999f * way / 17, corner, 36);
    expect_poses(1.001f * way / 35, corner, 36);
  }
  expect_poses(way / 100, 0, 144);
  expect_poses(way / 1000, 0, 256);  // at most
}

TEST(SweepPoses, OfOneMomentAreOne) {
  const Growing source(0);
  EXPECT_TRUE(Sweep::at(source, 3).any());
  EXPECT_EQ(source.times, std::set<float>{3});
}

TEST(SweepPoses, AStillSceneHasNone) {
  const test::TriangleSource still(scene::make_builtin("cornell"));
  EXPECT_FALSE(Sweep(still, 0.1f).any());
  EXPECT_FALSE(Sweep::at(still, 0).any());
  EXPECT_FALSE(Sweep(still, 0.1f).separates(vec3(-1), vec3(1)));
  EXPECT_EQ(Sweep(still, 0.1f).passes(vec3(0), 1), nullptr);
}

TEST(SweepSeparates, WhatARayOfThePartsTrianglesMeets) {
  // Short and long ways all around the door of two-rooms, half open.
  const test::TriangleSource source(scene::make_builtin("two-rooms"));
  const mat4 to_part = glm::inverse(source.part_pose(1, 0.5f));
  const Sweep half_open = Sweep::at(source, 0.5f);
  Pcg32 random(3);
  int between = 0;
  for (int i = 0; i < 400; ++i) {
    const vec3 a = vec3(0.3f, 1, -0.1f) + 2.4f * (random.uniform3() - 0.5f),
               b = a + (i % 2 ? 0.4f : 2.0f) * (random.uniform3() - 0.5f);
    const vec3 from(to_part * vec4(a, 1)), to(to_part * vec4(b, 1));
    const rays::RayQuery way{from, to - from, 1};
    std::uint8_t blocked = 0;
    source.occluded(1, {&way, 1}, {&blocked, 1});
    EXPECT_EQ(half_open.separates(a, b), blocked != 0) << i;
    between += blocked;
  }
  EXPECT_GT(between, 15);
}

}  // namespace
}  // namespace ssphh::place
