#pragma once
/// The directions of an SPHL's light: I(ω) from spherical harmonics in the lamp's axes, and a choice of
/// directions by it.

#include <ssphh/scene/emission.h>

#include "distribution.h"

namespace ssphh::shading {

class ShapedIntensity {
 public:
  /// Coefficients in the lamp's axes, which are the columns of `world`; their scale does not count.
  ShapedIntensity(sh::IntensitySh emission, const mat4& world);

  /// I ≥ 0 into a unit direction of the world, away from the lamp.
  vec3 toward(const vec3& direction) const;
  /// Mean of I over all directions.
  const vec3& mean() const { return mean_; }

  struct Direction {
    vec3 direction;  ///< unit, of the world
    float pdf;       ///< by solid angle; nowhere 0
  };
  /// By the luminance of I in cells of equal solid angle, evenly within each.
  Direction sample(const vec2& u) const;
  float pdf(const vec3& direction) const;

 private:
  vec3 to_local(const vec3& direction) const { return glm::normalize(direction * axes_); }

  sh::IntensitySh emission_;
  mat3 axes_;
  vec3 mean_{0};
  Distribution cells_;  ///< row by row in z, each row around z
};

}  // namespace ssphh::shading
