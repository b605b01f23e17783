#pragma once
/// Path-traced indirect irradiance as one number, Rec.709 luminance [W/m²].

#include <ssphh/rays/radiance_source.h>

namespace ssphh::study {

inline double true_luminance(const rays::IrradianceEstimate& estimate) {
  return static_cast<double>(luminance(estimate.indirect));
}

/// Standard deviation of true_luminance, at most: the channels share their paths, so their errors go the same
/// way.
inline double true_deviation(const rays::IrradianceEstimate& estimate) {
  return static_cast<double>(luminance(glm::sqrt(glm::max(estimate.indirect_variance, vec3(0)))));
}

}  // namespace ssphh::study
