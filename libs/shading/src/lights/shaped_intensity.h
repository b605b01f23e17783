#pragma once
/// The directions of an SPHL's light: I(ω) from spherical harmonics in the lamp's axes, and a choice of
/// directions by it.

#include <ssphh/scene/emission.h>

#include "distribution.h"
#include "lamp_shape.h"

namespace ssphh::shading {

class ShapedIntensity final : public LampShape {
 public:
  /// Coefficients in the lamp's axes, which are the columns of `world`; their scale does not count.
  ShapedIntensity(sh::IntensitySh emission, const mat4& world);

  vec3 toward(const vec3& direction) const override;
  vec3 mean() const override { return mean_; }
  /// Cells of equal solid angle.
  Direction sample(const vec2& u) const override;
  /// Nowhere 0.
  float pdf(const vec3& direction) const override;

 private:
  vec3 to_local(const vec3& direction) const { return glm::normalize(direction * axes_); }

  sh::IntensitySh emission_;
  mat3 axes_;
  vec3 mean_{0};
  Distribution cells_;  ///< row by row in z, each row around z
};

}  // namespace ssphh::shading
