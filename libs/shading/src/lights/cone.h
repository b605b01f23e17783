#pragma once
/// Uniform directions in a cone of half-angle θ around an axis.

#include <cmath>

#include <ssphh/core/sphere.h>

namespace ssphh::shading {

struct Cone {
  float sin2;       ///< sin² θ
  float one_minus;  ///< 1 − cos θ, without the cancellation that narrow cones would suffer

  explicit Cone(float sin2_theta)
      : sin2(glm::min(sin2_theta, 1.0f)), one_minus(sin2 / (1 + std::sqrt(1 - sin2))) {}

  float pdf() const { return 1 / (2 * pi * one_minus); }

  /// Unit direction around +z.
  vec3 sample(const vec2& u) const {
    const float x = u.x * one_minus;  // 1 − cos of the sampled angle
    const float r = std::sqrt(glm::max(x * (2 - x), 0.0f));
    return {r * unit_circle(u.y), 1 - x};
  }
};

}  // namespace ssphh::shading
