#pragma once
/// Lambertian reflection: f = ρ/π. Local frame, z the normal.

#include <ssphh/core/math.h>

namespace ssphh::shading {

/// f · cos θ_i for ρ = 1.
inline float lambert(const vec3& wi) {
  return wi.z / pi;
}

/// Density of cosine sampling, which every diffuse model here uses.
inline float cosine_pdf(const vec3& wi) {
  return wi.z / pi;
}

}  // namespace ssphh::shading
