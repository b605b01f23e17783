/// Memory as the tool tells of it: of the plain data that lookups keep.

#include <gtest/gtest.h>

#include <ssphh/geometry/tetrahedra.h>
#include <ssphh/methods/vct/pyramid.h>

#include "ddgi/field.h"
#include "probe_volume/probe_grid.h"

namespace ssphh::methods {
namespace {

const std::vector<vec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}};

TEST(KeptBytes, OfGridsAndMapsAreThoseOfTheirArrays) {
  probe_volume::ProbeGrid grid;
  grid.lattice.size = {3, 2, 2};
  grid.lattice.spacing = 1;
  for (int i = 0; i < 12; ++i) grid.probe.push_back(i), grid.positions.emplace_back(i % 3, i / 3 % 2, i / 6);
  EXPECT_EQ(probe_volume::GridWeights(grid).bytes(), 4u * (12 + 2)) << "of places, and of cells";
  const ddgi::DdgiField field(ddgi::ProbeGrid{vec3(0), vec3(1), {2, 1, 1}});
  EXPECT_EQ(field.bytes(), 2u * (12 + 1 + 64 * 12 + 256 * 8));
}

TEST(KeptBytes, OfVoxelsAreThoseOfAllLevels) {
  const vct::VoxelGrid grid{.origin = vec3(0), .voxel = 1, .resolution = 8, .size = {8, 8, 8}};
  const std::size_t voxel = 6 * 16;
  const vct::Pyramid dense(grid, vct::Storage::dense, {});
  EXPECT_EQ(dense.bytes(), (512 + 64) * voxel);
  EXPECT_EQ(dense.bricks(0), 8u);
  EXPECT_EQ(dense.bricks(1), 1u);
  const std::vector<vct::VoxelKey> two{vct::voxel_key({0, 0, 0}), vct::voxel_key({7, 0, 0})};
  const vct::Pyramid sparse(grid, vct::Storage::sparse, two);
  EXPECT_EQ(sparse.bricks(0), 2u);
  EXPECT_EQ(sparse.bricks(1), 1u);
  // A node is its eight children and its place.
  EXPECT_EQ(sparse.bytes(), 3 * (64 * voxel + 8 * 4 + 3 * 4));
}

TEST(KeptBytes, OfTetrahedraGrowWithTheirPoints) {
  const geometry::Tetrahedra four({five.data(), 4}), all(five);
  EXPECT_EQ(four.cells().size(), 1u);
  EXPECT_EQ(four.hull_size(), 4u);
  EXPECT_GT(all.bytes(), four.bytes());
}

}  // namespace
}  // namespace ssphh::methods
