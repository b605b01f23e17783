#include <limits>

#include <ssphh/probes/fitted_surfaces.h>

namespace ssphh::probes {

FittedSurfaces prepare_fitted(const scene::Scene& scene, float time, const FittedPoints& fitted,
                              const SeesProbe& sees, const Control& control) {
  require_whole(fitted, std::numeric_limits<std::size_t>::max());
  FittedSurfaces out;
  std::vector<rays::SurfacePoint> points;
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    if (fitted.weights[i].count == 0) continue;
    points.push_back(fitted.points[i]);
    out.weights.push_back(fitted.weights[i]);
  }
  out.surfaces = prepare_surfaces(scene, time, std::move(points), sees, control);
  return out;
}

}  // namespace ssphh::probes
