#pragma once
/// Light at fitted points: follows the probes.

#include <span>
#include <vector>

#include <ssphh/probes/fitted_surfaces.h>

#include "surface_light.h"

namespace ssphh::realtime {

class FittedLight {
 public:
  /// Throws Error for points that name a probe which there is not.
  FittedLight(const probes::FittedSurfaces& surfaces, int probe_count);

  /// New irradiance of some probes: evaluates the points that any of them lights. `irradiance` holds `count`
  /// coefficients, 25 at most, for each probe of the set, those changed or not.
  void update(std::span<const int> probes, std::span<const vec3> irradiance, std::size_t count,
              SurfaceLight& light, FrameCounters& counters);

 private:
  SurfaceLight::Coefficients evaluate(std::size_t point, std::span<const vec3> irradiance,
                                      std::size_t count) const;

  probes::FittedPoints points_;
  std::vector<std::size_t> first_of_probe_;  ///< in lit_by_: points that each probe lights
  std::vector<std::uint32_t> lit_by_;
  std::vector<unsigned char> marked_;  ///< points, while an update gathers them
  std::vector<std::uint32_t> changed_;
};

}  // namespace ssphh::realtime
