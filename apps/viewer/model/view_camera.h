#pragma once
/// The viewer's free camera as a value, and the gestures that move it: pure functions.

#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/query.h>

namespace ssphh::viewer {

/// Looks along −z of its orientation, y up.
struct View {
  vec3 eye{0};
  quat orientation{1, 0, 0, 0};  ///< camera to world
  float yfov = 0.8f;             ///< radians
  float focus = 3;               ///< metres in front of the eye: what orbit turns about
  bool orthographic = false;
  float yheight = 2;  ///< metres seen vertically, orthographic

  vec3 forward() const { return orientation * vec3(0, 0, -1); }
  vec3 right() const { return orientation * vec3(1, 0, 0); }
  vec3 up() const { return orientation * vec3(0, 1, 0); }
  vec3 center() const { return eye + focus * forward(); }
  friend bool operator==(const View&, const View&) = default;
};

/// The view of a scene's camera; scale and shear of its node are left out. The focus is `distance` ahead.
View view_of(const scene::CameraPose& pose, float distance);
scene::CameraPose pose_of(const View& view);

/// From `eye` toward `target`, y up; straight up or down keeps −z (+z) at the picture's top.
View look_at(const vec3& eye, const vec3& target, float yfov);

/// Turns on the spot: `yaw` about the world's y axis (positive: to the left), `pitch` upward, radians. Levels
/// the horizon; stops 1° short of the poles.
View turned(const View& view, float yaw, float pitch);

/// The same turn about the focus.
View orbited(const View& view, float yaw, float pitch);

/// Moves along the view's right, up and forward [m].
View moved(const View& view, const vec3& right_up_forward);

/// Nearer to the focus (factor under 1) or farther away from it; at least 1 mm remains.
View dollied(const View& view, float factor);

/// What is in focus, seen along a direction (any length but 0) from as far away, level.
View seen_along(const View& view, const vec3& direction);

/// Orthographic instead of perspective, or the other way round: what is in focus keeps its size.
View with_other_projection(const View& view);

/// The whole of `bounds` in sight, from the same direction. Unchanged for empty bounds.
View framed(const View& view, const scene::Bounds& bounds, float aspect);

/// Ray through a point of the picture, (0, 0) its lower left and (1, 1) its upper right corner. Unit
/// direction.
rays::RayQuery pixel_ray(const View& view, const vec2& point, float aspect);

/// Where a world point appears in the same coordinates, and its depth along the view axis [m] in z; z ≤ 0:
/// behind the eye (x and y tell nothing then).
vec3 project(const View& view, const vec3& point, float aspect);

}  // namespace ssphh::viewer
