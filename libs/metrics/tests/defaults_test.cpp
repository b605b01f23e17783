/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/false_edges.h>
#include <ssphh/metrics/flip.h>
#include <ssphh/metrics/perceptual.h>

namespace ssphh::metrics {
namespace {

TEST(Defaults, OfWhatCompares) {
  const FalseEdgeParams edges;
  EXPECT_EQ(edges.threshold, 0.03);
  EXPECT_EQ(edges.opponent_threshold, 0.06);
  EXPECT_EQ(edges.sigmas, 4);
  EXPECT_EQ(edges.floor, 0.05);
  EXPECT_EQ(edges.across, 8);
  EXPECT_EQ(edges.along, 8);
  // 3840 pixels of 0.7 m at 0.7 m: those that one degree at the middle of the screen spans
  EXPECT_NEAR(FlipParams().pixels_per_degree, 3840 * 3.14159265358979 / 180, 1e-9);
}

TEST(Defaults, OfResults) {
  const FalseEdges edges;
  EXPECT_EQ(edges.pixels + edges.tested + edges.edges, 0u);
  EXPECT_EQ(edges.share, 0);
  EXPECT_EQ(edges.least_step, 0);
  const ImageError error;
  EXPECT_EQ(error.width, 0);
  EXPECT_EQ(error.height, 0);
  EXPECT_EQ(error.pixels + error.nonfinite_pixels, 0u);
  for (const double value :
       {error.sum, error.mae, error.bias, error.max, error.mse, error.rmse, error.relmse, error.mape,
        error.smape, error.mean_ratio[0], error.mean_ratio[1], error.mean_ratio[2]})
    EXPECT_EQ(value, 0);
  const BlockError block;
  for (const int value : {block.block, block.columns, block.rows, block.max_column, block.max_row})
    EXPECT_EQ(value, 0);
  EXPECT_EQ(block.max, 0);
  EXPECT_EQ(block.mean, 0);
  const FlipError flip;
  EXPECT_EQ(flip.mean, 0);
  EXPECT_EQ(flip.first_exposure, 0);
  EXPECT_EQ(flip.last_exposure, 0);
  EXPECT_EQ(flip.exposures, 0);
  EXPECT_EQ(DisplayError().psnr, 0);
  EXPECT_EQ(DisplayError().ssim, 0);
}

}  // namespace
}  // namespace ssphh::metrics
