/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/probe_export/light_grid.h>
#include <ssphh/probe_export/target.h>

namespace ssphh::probe_export {
namespace {

TEST(Defaults, OfGrids) {
  const GridParams params;
  EXPECT_EQ(params.spacing, 0);
  EXPECT_EQ(params.most, 1048576u);
  EXPECT_EQ(params.most_cells, 290);
  const GridShape shape;
  EXPECT_EQ(shape.low, vec3(0));
  EXPECT_EQ(shape.cell, vec3(1));
  EXPECT_EQ(shape.size, glm::ivec3(0));
}

TEST(Defaults, OfResults) {
  EXPECT_EQ(Exported().points, 0u);
  EXPECT_EQ(Exported().filled, 0u);
}

}  // namespace
}  // namespace ssphh::probe_export
