#pragma once
/// Primary rays.

#include <ssphh/trace/render_state.h>

#include "rays.h"

namespace ssphh::trace {

/// The camera of a render, ready to make rays. Scale in the camera's node is ignored.
class CameraRays {
 public:
  /// Throws Error for a field of view that cannot be, or a pose that is not finite.
  explicit CameraRays(const RenderParams& params);

  /// `x`, `y` in pixels from the upper left, 0..width and 0..height.
  Ray ray(float x, float y) const;

  /// What the depth image stores: distance along the view axis; from the eye for whole-sphere projections.
  float depth(const Ray& ray, float distance) const;

 private:
  Projection projection_;
  float width_, height_;
  vec3 origin_, right_, up_, forward_;
  vec2 half_extent_{1};  ///< of the image plane at distance 1, or in metres if orthographic
};

}  // namespace ssphh::trace
