#pragma once
/// What the integrator asks of the geometry, and the ray bookkeeping of one task.

#include <cstdint>
#include <limits>
#include <vector>

#include <ssphh/core/math.h>

#include "ray_recording.h"

namespace ssphh::trace {

/// Directions are unit vectors; the ray covers the open interval (t_min, t_max). What has gone straight
/// through glass keeps its origin, from which the distances of lights and their densities count.
struct Ray {
  vec3 origin;
  vec3 direction;
  float t_max = std::numeric_limits<float>::infinity();
  float t_min = 0;
};

/// Which glass lets rays pass as if it was not there; what it leaves of their light, transmittance() tells.
enum class PassedGlass {
  none,
  smooth_sheets,  ///< those through which light goes on straight
  all             ///< refraction and roughness left out
};

/// What lets rays pass.
struct Passage {
  /// With a seed surfaces are there with the probability of their coverage, and any share of glass lets pass.
  /// With 0 coverage and shares from ½ on count as all, less as nothing.
  std::uint64_t seed = 0;
  PassedGlass glass = PassedGlass::all;

  Passage(std::uint64_t seed_in, PassedGlass glass_in = PassedGlass::all) : seed(seed_in), glass(glass_in) {}
};

/// Nearest intersection. `barycentric` weighs the triangle's second and third vertex.
struct Hit {
  int instance;
  std::uint32_t triangle;
  vec2 barycentric;
  float distance;
};

/// Counters of one task (an image row): added up once at its end, so that rays cost no atomic operation.
struct RayTask {
  std::uint64_t rays = 0;
  std::uint64_t invalid = 0;                   ///< contributions that were NaN or infinite, and left out
  std::vector<RecordedRay>* record = nullptr;  ///< for benchmarks
};

/// Height above a surface from which new rays start: a bound of the rounding errors in a position that was
/// computed from coordinates of this magnitude, and in Embree's plane distance. 16 half-ulps: three roundings
/// of the transform, four of the interpolation, the rest for the intersection of the next ray.
inline float position_error(float coordinate_magnitude) {
  return 16 * 0x1p-24f * coordinate_magnitude;
}

inline float max_abs_component(const vec3& v) {
  return max_component(glm::abs(v));
}

/// Distance up to which a shadow ray toward a light looks: relative, so that it holds at any scale, and
/// shortened by the rounding error of both ends far from the origin.
inline float shadow_distance(const vec3& origin, float distance) {
  return distance * (1 - 1e-4f) - 2 * position_error(max_abs_component(origin));
}

}  // namespace ssphh::trace
