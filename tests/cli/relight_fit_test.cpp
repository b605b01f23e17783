// Weights that are fitted to a run: at as many of its frames as were asked for, evenly spaced, never at more
// than there are.

#include <gtest/gtest.h>

#include "commands/relight.h"

namespace ssphh::app {
namespace {

/// The errors of two frames of a lamp that goes from one side of a room to the other.
std::vector<double> errors(int fit_frames) {
  RelightOptions options;
  options.scene.source = "builtin:two-rooms";
  options.place.probes = "scene";
  options.animate = {"lamp.position=-2.5,2,0:-0.5,1,0.5"};
  options.frames = 2, options.truth = 1, options.points = 6, options.truth_spp = 2, options.max_depth = 2;
  options.params.degree = 0;
  options.params.transport.directions = 16, options.params.transport.link_rays = 8;
  options.params.transport.surfel_size = 1;
  options.weights = probes::WeightMethod::fitted, options.fit_frames = fit_frames;
  std::vector<double> all;
  for (const FrameError& e : run_relight(options).run.errors) all.push_back(e.error.luminance.mean_relative);
  return all;
}

TEST(RelightFit, IsToFramesEvenlySpacedOverTheRun) {
  const std::vector<double> first = errors(1), both = errors(2), more = errors(9);
  EXPECT_EQ(first.size(), 2u);
  EXPECT_EQ(both, more) << "there are two frames";
  EXPECT_NE(first, both) << "the last frame has its share";
}

}  // namespace
}  // namespace ssphh::app
