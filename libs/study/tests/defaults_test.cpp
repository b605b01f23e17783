/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/study/converged_truth.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/lint.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/study/surface_points.h>

namespace ssphh::study {
namespace {

TEST(Defaults, OfWhatMeasures) {
  const LeakParams leak;
  EXPECT_EQ(leak.dark_share, 1e-4f);
  EXPECT_EQ(leak.sigmas, 3);
  EXPECT_EQ(leak.path.max_depth, 25);
  EXPECT_EQ(leak.path.passes, 1);
  EXPECT_EQ(leak.path.spp, 256);
  EXPECT_EQ(leak.path.seed, 0u);
  EXPECT_EQ(leak.mean, 0);
  EXPECT_EQ(most_truth_spp, 65536);
  EXPECT_EQ(most_truth_paths, std::size_t{1} << 24);
  const LintParams lint;
  EXPECT_EQ(lint.clearance, 0);
  EXPECT_EQ(lint.negative_tolerance, 0.1f);
  EXPECT_EQ(lint.spacing, 0);
  const SurfacePointParams points;
  EXPECT_EQ(points.count, 1024);
  EXPECT_EQ(points.seed, 0u);
  EXPECT_EQ(points.clearance, 0);
}

TEST(StudyValues, OfMeasurements) {
  const LeakReport leak;
  EXPECT_EQ(leak.ratio, 0);
  EXPECT_EQ(leak.dark, 0u);
  EXPECT_EQ(leak.mean_truth, 0);
  EXPECT_EQ(leak.mean_looked_up, 0);
  EXPECT_EQ(leak.truth_noise, 0);
  const TruthAtPoints truth;
  EXPECT_EQ(truth.dark, 0u);
  EXPECT_EQ(truth.mean, 0);
  EXPECT_EQ(truth.noise, 0);
  const LookupError error;
  EXPECT_EQ(error.points, 0u);
  for (const RelativeError& e : {error.channels[0], error.channels[1], error.channels[2], error.luminance})
    for (const double value : {e.mean_truth, e.ratio, e.mean_relative, e.median_relative, e.p95_relative,
                               e.noise, e.mean_error, e.relmse})
      EXPECT_EQ(value, 0);
  for (const double value : {error.chromaticity.mean, error.chromaticity.p95, error.chromaticity.noise,
                             error.chromaticity.mean_error})
    EXPECT_EQ(value, 0);
  EXPECT_EQ(relative_floor, 0.01);
  const LintProblem problem;
  EXPECT_EQ(problem.kind, ProbeProblem::inside);
  EXPECT_EQ(problem.probe, -1);
  EXPECT_EQ(problem.position, vec3(0));
}

}  // namespace
}  // namespace ssphh::study
