#pragma once
/// What lamps that shine unevenly have in common: I(ω), and a choice of directions by it.

#include <ssphh/core/math.h>

namespace ssphh::shading {

class LampShape {
 public:
  virtual ~LampShape() = default;

  /// I ≥ 0 into a unit direction of the world, away from the lamp.
  virtual vec3 toward(const vec3& direction) const = 0;
  /// Mean of I over all directions.
  virtual vec3 mean() const = 0;

  struct Direction {
    vec3 direction;  ///< unit, of the world
    float pdf;       ///< by solid angle
  };
  /// By the luminance of I in cells, evenly within each.
  virtual Direction sample(const vec2& u) const = 0;
  /// Where it is 0, so is I.
  virtual float pdf(const vec3& direction) const = 0;
};

}  // namespace ssphh::shading
