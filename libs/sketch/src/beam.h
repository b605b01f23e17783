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

  /// Of the rays of a rectangle x0, y0, x1, y1 [pixels], and of all within `margin` of these: an angle [rad],
  /// or a distance [m] where rays are `parallel`.
  static Beam of(const Eye& eye, const vec4& rectangle, float margin, bool parallel);

  bool meets_ball(const vec3& center, float ball_radius) const;
  bool meets_line(const vec3& a, const vec3& b) const;
};

}  // namespace ssphh::sketch
