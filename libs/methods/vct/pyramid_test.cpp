/// Levels of voxels: what filtering keeps, and that the octree holds what whole arrays hold.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/methods/vct/cone_light.h>

namespace ssphh::methods::vct {
namespace {

VoxelGrid cube(int size) {
  VoxelGrid grid;
  grid.resolution = size;
  grid.size = {size, size, size};
  return grid;
}

/// Keys of a layer of voxels at height y.
std::vector<VoxelKey> layer(int size, int y) {
  std::vector<VoxelKey> keys;
  for (int z = 0; z < size; ++z) {
    for (int x = 0; x < size; ++x) keys.push_back(voxel_key({x, y, z}));
  }
  return keys;
}

/// Of all voxels of a level, in faces of level 0.
vec4 sum_of_side(const Pyramid& voxels, int level, int side) {
  vec4 sum(0);
  const Cell size = voxels.grid().level_size(level);
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const Voxel* voxel = voxels.find(level, {x, y, z});
        if (voxel) sum += voxel->side[side] * std::ldexp(1.0f, 2 * level);
      }
    }
  }
  return sum;
}

TEST(VctPyramid, OneLayerKeepsItsLightAndOpacityOnEveryLevel) {
  const VoxelGrid grid = cube(32);
  const std::vector<VoxelKey> keys = layer(32, 13);
  Pyramid voxels(grid, Storage::sparse, keys);
  Pcg32 random(1);
  for (const VoxelKey key : keys) {
    for (vec4& side : voxels.find(0, voxel_cell(key))->side) {
      const float opacity = random.uniform();
      side = vec4(opacity * 3 * random.uniform3(), opacity);
    }
  }
  voxels.filter();
  // Seen along the layer, voxels hide each other; from above and below they do not.
  for (const int side : {2, 3}) {
    const vec4 whole = sum_of_side(voxels, 0, side);
    for (int level = 1; level < voxels.levels(); ++level) {
      const vec4 here = sum_of_side(voxels, level, side);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(here[c] / whole[c], 1, 1e-5f) << level;
    }
  }
}

TEST(VctPyramid, TheNearerOfTwoOpaqueLayersHidesTheOther) {
  std::vector<VoxelKey> keys = layer(16, 6), more = layer(16, 7);
  keys.insert(keys.end(), more.begin(), more.end());
  Pyramid voxels(cube(16), Storage::sparse, keys);
  for (const VoxelKey key : keys) {
    const bool upper = voxel_cell(key).y == 7;
    for (vec4& side : voxels.find(0, voxel_cell(key))->side)
      side = upper ? vec4(1, 0, 0, 1) : vec4(0, 2, 0, 1);
  }
  voxels.filter();
  const Voxel* joined = voxels.find(1, {4, 3, 4});
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->side[2], vec4(1, 0, 0, 1)) << "from above";
  EXPECT_EQ(joined->side[3], vec4(0, 2, 0, 1)) << "from below";
  EXPECT_EQ(joined->side[0], vec4(0.5f, 1, 0, 1)) << "from the side: half of each";
}

TEST(VctPyramid, PiecesOfOneSurfaceCoverWhatTheOthersLeave) {
  // A plane that lies slanted passes through two voxels of a column, with a share in each.
  std::array<Voxel, 2> pieces;
  pieces[0].side[2] = vec4(0.3f * vec3(1, 2, 3), 0.3f);
  pieces[1].side[2] = vec4(0.7f * vec3(1, 2, 3), 0.7f);
  const Voxel joined = join_voxels(
      {&pieces[0], &pieces[0], &pieces[1], &pieces[1], &pieces[0], &pieces[0], &pieces[1], &pieces[1]});
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(joined.side[2][c], vec4(1, 2, 3, 1)[c], 1e-6f);
  EXPECT_EQ(joined.side[3], vec4(0));
}

/// Voxels on the skin of a ball, with random light.
std::vector<VoxelKey> ball(int size) {
  std::vector<VoxelKey> keys;
  const float middle = 0.5f * static_cast<float>(size);
  for (int z = 0; z < size; ++z) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const float r = glm::length(vec3(x, y, z) + 0.5f - middle);
        if (std::abs(r - 0.4f * static_cast<float>(size)) < 0.6f) keys.push_back(voxel_key({x, y, z}));
      }
    }
  }
  return keys;
}

Pyramid lit_ball(int size, Storage storage) {
  const std::vector<VoxelKey> keys = ball(size);
  Pyramid voxels(cube(size), storage, keys);
  for (const VoxelKey key : keys) {
    Pcg32 random(3, key);
    for (vec4& side : voxels.find(0, voxel_cell(key))->side) {
      const float opacity = random.uniform();
      side = vec4(opacity * random.uniform3(), opacity);
    }
  }
  voxels.filter();
  return voxels;
}

TEST(VctPyramid, TheOctreeHoldsWhatWholeArraysHold) {
  const Pyramid sparse = lit_ball(32, Storage::sparse), dense = lit_ball(32, Storage::dense);
  for (int level = 0; level < sparse.levels(); ++level) {
    const Cell size = sparse.grid().level_size(level);
    for (int z = -1; z <= size.z; ++z) {
      for (int y = -1; y <= size.y; ++y) {
        for (int x = -1; x <= size.x; ++x) {
          const Voxel *a = sparse.find(level, {x, y, z}), *b = dense.find(level, {x, y, z});
          const bool inside = x >= 0 && y >= 0 && z >= 0 && x < size.x && y < size.y && z < size.z;
          ASSERT_EQ(b != nullptr, inside);
          const Voxel empty;
          ASSERT_EQ((a ? *a : empty).side, (b ? *b : empty).side)
              << level << ": " << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
  for (int i = 0; i < 200; ++i) {
    Pcg32 random(5, static_cast<std::uint64_t>(i));
    const vec3 origin = 32.0f * random.uniform3(), to = 32.0f * random.uniform3();
    const float tangent = 0.6f * random.uniform();
    EXPECT_EQ(trace_cone(sparse, origin, glm::normalize(to - origin), tangent, {}),
              trace_cone(dense, origin, glm::normalize(to - origin), tangent, {}));
  }
}

TEST(VctPyramid, OctreesGrowWithTheSurface) {
  // A ball twice as fine has four times the bricks, not eight times.
  const auto bytes = [](int size) {
    return static_cast<double>(Pyramid(cube(size), Storage::sparse, ball(size)).bytes());
  };
  const double growth = bytes(128) / bytes(64);
  EXPECT_GT(growth, 3);
  EXPECT_LT(growth, 5);
  const std::vector<VoxelKey> keys = ball(64);
  std::vector<VoxelKey> bricks;
  for (const VoxelKey key : keys) {
    const Cell c = voxel_cell(key);
    bricks.push_back(voxel_key({c.x / 4, c.y / 4, c.z / 4}));
  }
  std::ranges::sort(bricks);
  bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
  EXPECT_EQ(Pyramid(cube(64), Storage::sparse, keys).bricks(0), bricks.size());
}

TEST(VctPyramid, TooManyVoxelsAreRefusedBeforeMemoryIsTaken) {
  EXPECT_THROW(Pyramid(cube(1024), Storage::dense, {}), Error);
  EXPECT_THROW(Pyramid(cube(16), Storage::sparse, layer(16, 3), 1000), Error);
}

}  // namespace
}  // namespace ssphh::methods::vct
