#pragma once
/// Rings about a lamp by which it is turned, and round steps for what is dragged: pure functions.

#include <optional>
#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::viewer {

/// A circle about an axis, by which a thing at its centre is turned about that axis.
struct Ring {
  vec3 center{0};
  vec3 axis{0, 1, 0};  ///< unit
  float radius = 1;    ///< [m]
};

/// So many points around it and the first one again.
std::vector<vec3> ring_points(const Ring& ring, int corners);

/// How a ring is held that is dragged.
struct RingGrip {
  Ring ring;
  /// Unit vector from its centre to where it was taken; of a ring that is seen from the side to what is
  /// nearest to the eye, along whose tangent the mouse goes.
  vec3 grabbed{1, 0, 0};
  bool edge_on = false;
  float along = 0;  ///< of the mouse on that tangent then [m]
  mat4 start{1};    ///< pose of the thing then
};

/// Takes a ring by the ray under the mouse.
RingGrip taken(const Ring& ring, const rays::RayQuery& ray, const mat4& start);

/// By how much the mouse has turned the ring since, counter-clockwise about its axis [rad]; none where its
/// ray does not tell.
std::optional<float> turned_by(const RingGrip& grip, const rays::RayQuery& ray);

/// A pose turned on the spot about an axis of the world (unit), by an angle [rad].
mat4 turned_about(const mat4& world, const vec3& axis, float angle);

/// The nearest whole multiple of a step; the value itself for a step of 0.
float in_steps(float value, float step);
/// The same of a place along one axis, 0..2, or of all three with −1.
vec3 in_steps(const vec3& place, int axis, float step);

/// Where a direction points: degrees about the vertical from −z, positive to the left of who looks there, and
/// above the horizon. Straight up and down have a pan of 0.
struct PanTilt {
  float pan = 0, tilt = 0;
};
PanTilt pan_tilt_of(const vec3& direction);
vec3 direction_of(const PanTilt& angles);

}  // namespace ssphh::viewer
