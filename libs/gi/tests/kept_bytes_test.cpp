/// Memory as the tool tells of it: of the plain data that lookups keep.

#include <gtest/gtest.h>

#include <ssphh/gi/nearest.h>
#include <ssphh/gi/vct/pyramid.h>

#include "fitted_lookup_weights.h"
#include "methods/ddgi/field.h"
#include "methods/irradiance-volume/probe_grid.h"
#include "methods/irradiance-volume/tetrahedra.h"
#include "methods/kept_weights.h"

namespace ssphh::gi {
namespace {

const std::vector<vec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}};
const SeesProbe open = [](const vec3&, const vec3&) { return true; };

TEST(KeptBytes, OfWeightsAreThoseOfPlacesAndTheirTree) {
  // A place and its index, and the axis of a split.
  EXPECT_EQ(NearestPoints(five).bytes(), 5u * (16 + 1));
  for (const WeightMethod method : {WeightMethod::distance, WeightMethod::trilinear, WeightMethod::mls}) {
    WeightParams params;
    params.method = method;
    const auto weights = make_weights(five, open, params);
    EXPECT_EQ(weights->bytes(), 5u * (12 + 17));
    EXPECT_EQ(methods::KeptWeights(*weights).bytes(), weights->bytes());
  }
}

TEST(KeptBytes, OfFittedPointsAreThoseThatHaveWeights) {
  FittedPoints fitted;
  fitted.points.resize(3);
  fitted.weights.resize(3);
  fitted.points[1].position = {1, 0, 0}, fitted.points[2].position = {0, 0, 1};
  fitted.weights[0].add(0, 1);
  fitted.weights[2].add(0, 0.5f), fitted.weights[2].add(4, 0.5f);
  const auto weights = make_weights(five, open, {}, &fitted);
  // Two points with 12 bytes of place, 6 of normal and 17 in the tree; three places of first weights; three
  // weights of 2 + 4 bytes; and the fallback.
  EXPECT_EQ(weights->bytes(), 2u * (12 + 6 + 17) + 3 * 4 + 3 * 6 + 5 * (12 + 17));
}

TEST(KeptBytes, OfGridsAndMapsAreThoseOfTheirArrays) {
  ProbeGrid grid;
  grid.lattice.size = {3, 2, 2};
  grid.lattice.spacing = 1;
  for (int i = 0; i < 12; ++i) grid.probe.push_back(i), grid.positions.emplace_back(i % 3, i / 3 % 2, i / 6);
  EXPECT_EQ(GridWeights(grid).bytes(), 4u * (12 + 2)) << "of places, and of cells";
  const methods::DdgiField field(methods::ProbeGrid{vec3(0), vec3(1), {2, 1, 1}});
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
  const Tetrahedra four({five.data(), 4}), all(five);
  EXPECT_EQ(four.cells().size(), 1u);
  EXPECT_EQ(four.hull_size(), 4u);
  EXPECT_GT(all.bytes(), four.bytes());
}

}  // namespace
}  // namespace ssphh::gi
