#pragma once
/// Fitted weights (FittedPoints) made ready to be looked up without rays.

#include <ssphh/probes/fitted_points.h>
#include <ssphh/probes/surface_lists.h>

namespace ssphh::probes {

struct FittedSurfaces {
  SurfaceLists surfaces;  ///< of the points that have weights
  std::vector<PointWeights> weights;

  bool empty() const { return surfaces.empty(); }
};

/// Prepares, as prepare_surfaces() does, the points that have weights.
FittedSurfaces prepare_fitted(const scene::Scene& scene, float time, const FittedPoints& fitted,
                              const SeesProbe& sees, const Control& control = {});

}  // namespace ssphh::probes
