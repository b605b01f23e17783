#pragma once
/// Reflectance of the boundary between two dielectrics.

#include <cmath>

#include <ssphh/core/math.h>

namespace ssphh::shading {

/// For light whose field swings across the plane of incidence (s) or in it (p).
struct Polarised {
  float s, p;
};

/// Cosine of the refracted direction; 0 where all is reflected. `eta`: index beyond over index before.
inline float refracted_cosine(float cosine, float eta) {
  const float sine2 = (1 - cosine * cosine) / (eta * eta);
  return std::sqrt(glm::max(1 - sine2, 0.0f));
}

/// Fresnel's formulas (Born and Wolf, Principles of Optics, §1.5.2), exact; 1 where all is reflected.
inline Polarised fresnel_reflectance(float cosine, float eta) {
  const float before = glm::clamp(cosine, 1e-6f, 1.0f), beyond = refracted_cosine(before, eta);
  if (!(beyond > 0)) return {1, 1};
  const float s = (before - eta * beyond) / (before + eta * beyond);
  const float p = (eta * before - beyond) / (eta * before + beyond);
  return {s * s, p * p};
}

}  // namespace ssphh::shading
