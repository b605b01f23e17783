#pragma once
/// Deterministic random inputs for the tests of this module.

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::test {

/// Coefficients uniform in [−1, 1).
template <class Sh = sh::RadianceSh>
Sh random_sh(int degree, std::uint64_t seed) {
  Pcg32 random(seed);
  Sh sh(degree);
  for (vec3& value : sh.values) value = 2.0f * random.uniform3() - 1.0f;
  return sh;
}

/// Uniform on the sphere, normalised in double precision.
inline glm::dvec3 random_direction(Pcg32& random) {
  return glm::normalize(glm::dvec3(sample_uniform_sphere(random.uniform2())));
}

inline float largest_difference(const vec3& a, const vec3& b) {
  return max_component(glm::abs(a - b));
}

template <class Sh>
float largest_difference(const Sh& a, const Sh& b) {
  float largest = a.values.size() == b.values.size() ? 0.0f : INFINITY;
  for (std::size_t k = 0; k < std::min(a.values.size(), b.values.size()); ++k) {
    largest = std::max(largest, largest_difference(a.values[k], b.values[k]));
  }
  return largest;
}

}  // namespace ssphh::test
