#pragma once
/// All rays of a rectangle of the picture at once, and which marks they may meet.

#include <ssphh/core/math.h>
#include <ssphh/sketch/draw.h>

namespace ssphh::sketch {

/// A cone around an axis, or a cylinder where rays are parallel.
struct Beam {
  Ray axis;
  float radius = 0;     ///< at the axis' origin [m]
  float tangent = 0;    ///< of the half angle
  bool bounded = true;  ///< false: it is wider than a cone can be, and meets everything

  /// Of the rays of [x0, x1] × [y0, y1], and of all within `margin` pixels of these.
  static Beam of(const Eye& eye, float x0, float y0, float x1, float y1, float margin);

  bool meets_ball(const vec3& center, float ball_radius) const;
  bool meets_line(const vec3& a, const vec3& b) const;
};

}  // namespace ssphh::sketch
