#pragma once
/// Surface points with the weights of the probes that light them: plain data, made by fit_weights
/// (fitted_weights.h), stored in probe files.

#include <vector>

#include <ssphh/probes/weight_list.h>
#include <ssphh/rays/surface_point.h>

namespace ssphh::probes {

/// Points with their weights, none of them negative. `weights[i].count` is 0 where no probe sees point i.
struct FittedPoints {
  std::vector<rays::SurfacePoint> points;
  std::vector<PointWeights> weights;

  friend bool operator==(const FittedPoints&, const FittedPoints&);
};

/// Throws Error unless every point stands at a finite place and has its weights: finite, at most max_weights,
/// of probes 0..probe_count − 1.
void require_whole(const FittedPoints& fitted, std::size_t probe_count);

}  // namespace ssphh::probes
