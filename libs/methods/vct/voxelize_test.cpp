/// Cutting triangles at the voxels against a test of every voxel.

#include "voxelize.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>

namespace ssphh::methods::vct {
namespace {

using Corners = std::array<vec3, 3>;

/// Separating axes of a triangle and a box (Akenine-Möller, Fast 3D Triangle-Box Overlap Testing, 2001).
bool overlap(const Corners& corners, const vec3& center, float half) {
  const vec3 v[3] = {corners[0] - center, corners[1] - center, corners[2] - center};
  const vec3 edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  std::vector<vec3> axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, glm::cross(edges[0], edges[1])};
  for (const vec3& edge : edges) {
    for (int i = 0; i < 3; ++i) {
      vec3 unit(0);
      unit[i] = 1;
      axes.push_back(glm::cross(edge, unit));
    }
  }
  for (const vec3& axis : axes) {
    const float reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    const float a = glm::dot(axis, v[0]), b = glm::dot(axis, v[1]), c = glm::dot(axis, v[2]);
    if (std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach) return false;
  }
  return true;
}

VoxelGrid unit_grid(int size) {
  VoxelGrid grid;
  grid.resolution = size;
  grid.size = {size, size, size};
  return grid;
}

Corners random_triangle(std::uint64_t index, float size) {
  Pcg32 random(7, index);
  // Large and small ones, and some in the plane of voxel walls' middles.
  const float extent = index % 2 ? size : 1.5f;
  const vec3 from = index % 2 ? vec3(0) : random.uniform3() * (size - extent);
  Corners corners;
  for (vec3& corner : corners) corner = from + extent * random.uniform3();
  if (index % 5 == 0) {
    for (vec3& corner : corners) corner.y = std::floor(from.y) + 0.5f;
  }
  return corners;
}

TEST(VoxelGrid, HoldsTheSceneAVoxelWithinItsBorderInAsFewBricksAsDo) {
  scene::Bounds bounds;
  bounds.add(vec3(1, 2, 3)), bounds.add(vec3(5, 3.8f, 4));
  const VoxelGrid grid = make_grid(bounds, 32);
  // 30 voxels along the longest side, 13.5 and 7.5 along the others, and one more on each side
  EXPECT_FLOAT_EQ(grid.voxel, 4.0f / 30);
  EXPECT_EQ(grid.size, (Cell{32, 16, 12}));
  for (int axis = 0; axis < 3; ++axis) {
    const float whole = grid.voxel * static_cast<float>(grid.size[axis]);
    EXPECT_NEAR(grid.origin[axis] + 0.5f * whole, bounds.center()[axis], 1e-5f) << axis;
    EXPECT_GE(bounds.min[axis] - grid.origin[axis], 0.999f * grid.voxel) << axis;
  }
}

TEST(VctVoxelize, EveryVoxelThatATriangleMeetsAndNoOther) {
  constexpr int size = 12;
  const VoxelGrid grid = unit_grid(size);
  for (std::uint64_t t = 0; t < 200; ++t) {
    const Corners corners = random_triangle(t, size);
    std::vector<Fragment> fragments;
    cut_triangle(grid, corners, fragments);
    std::set<VoxelKey> met;
    for (const Fragment& fragment : fragments) EXPECT_TRUE(met.insert(fragment.voxel).second);
    for (int z = 0; z < size; ++z) {
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const vec3 center = vec3(x, y, z) + 0.5f;
          // What is met by less than a ten thousandth of the edge may go either way.
          const bool has = met.contains(voxel_key({x, y, z}));
          EXPECT_TRUE(has || !overlap(corners, center, 0.5f - 1e-4f))
              << t << ": " << x << ' ' << y << ' ' << z;
          EXPECT_TRUE(!has || overlap(corners, center, 0.5f + 1e-4f))
              << t << ": " << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
}

TEST(VctVoxelize, PiecesAddUpToTheTriangle) {
  constexpr int size = 12;
  const VoxelGrid grid = unit_grid(size);
  for (std::uint64_t t = 0; t < 200; ++t) {
    const Corners corners = random_triangle(t, size);
    std::vector<Fragment> fragments;
    cut_triangle(grid, corners, fragments);
    vec3 area(0), moment(0);
    for (const Fragment& fragment : fragments) {
      const float piece = glm::length(fragment.area);
      area += fragment.area, moment += piece * fragment.centroid;
      const Cell cell = voxel_cell(fragment.voxel);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(fragment.centroid[axis], static_cast<float>(cell[axis]) - 1e-4f);
        EXPECT_LE(fragment.centroid[axis], static_cast<float>(cell[axis]) + 1 + 1e-4f);
      }
    }
    const vec3 whole = 0.5f * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float size_of_whole = glm::length(whole);
    EXPECT_LT(glm::length(area - whole), 1e-4f * size_of_whole + 1e-6f);
    const vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0f;
    EXPECT_LT(glm::length(moment / size_of_whole - middle), 1e-3f);
  }
}

TEST(VctVoxelize, WhatLiesOutsideIsDropped) {
  const VoxelGrid grid = unit_grid(8);
  std::vector<Fragment> fragments;
  cut_triangle(grid, {vec3(-20, 3.5f, -20), vec3(-20, 3.5f, 60), vec3(60, 3.5f, -20)}, fragments);
  EXPECT_EQ(fragments.size(), 64u);
  fragments.clear();
  cut_triangle(grid, {vec3(9, 0, 0), vec3(12, 5, 0), vec3(9, 5, 5)}, fragments);
  cut_triangle(grid, {vec3(-9, 0, 0), vec3(-1, 5, 0), vec3(-9, 5, 5)}, fragments);
  cut_triangle(grid, {vec3(NAN, 0, 0), vec3(1, 5, 0), vec3(2, 5, 5)}, fragments);
  EXPECT_TRUE(fragments.empty());
}

}  // namespace
}  // namespace ssphh::methods::vct
