#pragma once
/// Rough diffuse reflection after Oren and Nayar 1994 in Fujii's form ("A tiny improvement of Oren–Nayar
/// reflectance model", 2013), which has no dark ring, needs no angles and never reflects more than ρ.

#include <ssphh/core/math.h>

namespace ssphh::shading {

/// f · cos θ_i for ρ = 1. `sigma` in [0, 1]; 0 is Lambert. Reciprocal.
inline float oren_nayar(float sigma, const vec3& wo, const vec3& wi) {
  const float s = wo.x * wi.x + wo.y * wi.y;  // sin θ_i sin θ_o cos(φ_i − φ_o)
  const float t = s > 0 ? glm::max(wo.z, wi.z) : 1.0f;
  return wi.z * (1 + sigma * s / t) / (pi + (pi / 2 - 2.0f / 3.0f) * sigma);
}

}  // namespace ssphh::shading
