#pragma once
/// Path-traced truth with as many paths as its noise asks for.

#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::study {

struct ConvergedTruth {
  std::vector<rays::IrradianceEstimate> estimates;  ///< one for each point
  int spp = 0;                                      ///< paths that each point got
};

/// A truth gets no more paths, for each point and in all; the parameters' own number is always traced.
inline constexpr int most_truth_spp = 1 << 16;
inline constexpr std::size_t most_truth_paths = std::size_t{1} << 24;

/// Path traces the points, all alike: at first with the parameters' paths, then in rounds of other paths, of
/// as many as before in all, until the mean relative noise (RelativeError::noise of the worst channel) is at
/// most `noise`, and the standard error of all points' light together a third of that; 0: no further round.
/// Points that are hard do not get more than others: stopping each by itself would favour those whose rare
/// bright paths have not come yet.
ConvergedTruth converged_truth(const rays::RadianceSource& source, std::span<const rays::SurfacePoint> points,
                               const rays::PathParams& path, double noise, const Control& control = {});

}  // namespace ssphh::study
