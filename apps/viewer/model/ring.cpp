#include "ring.h"

#include <algorithm>
#include <cmath>

#include "pick.h"

namespace ssphh::viewer {
namespace {

/// Cosine between ray and axis below which a ring's plane is seen too much from the side to follow the mouse.
constexpr float least_slope = 0.2f;

std::optional<float> along_tangent(const RingGrip& grip, const rays::RayQuery& ray) {
  return along_axis(ray, grip.ring.center + grip.ring.radius * grip.grabbed,
                    glm::cross(grip.ring.axis, grip.grabbed));
}

}  // namespace

std::vector<vec3> ring_points(const Ring& ring, int corners) {
  const Frame frame = Frame::around(ring.axis);
  std::vector<vec3> points;
  for (int i = 0; i <= corners; ++i) {
    const float angle = 2 * pi * static_cast<float>(i % corners) / static_cast<float>(corners);
    points.push_back(ring.center + ring.radius * (std::cos(angle) * frame.x + std::sin(angle) * frame.y));
  }
  return points;
}

RingGrip taken(const Ring& ring, const rays::RayQuery& ray, const mat4& start) {
  RingGrip grip{.ring = ring, .start = start};
  const auto point = on_plane(ray, ring.center, ring.axis);
  grip.edge_on = !point || std::abs(glm::dot(ray.direction, ring.axis)) < least_slope;
  if (grip.edge_on) {
    grip.grabbed = -glm::normalize(ray.direction - glm::dot(ray.direction, ring.axis) * ring.axis);
    grip.along = along_tangent(grip, ray).value_or(0);
  } else if (const vec3 from = *point - ring.center; from != vec3(0)) {
    grip.grabbed = glm::normalize(from);
  }
  return grip;
}

std::optional<float> turned_by(const RingGrip& grip, const rays::RayQuery& ray) {
  if (grip.edge_on) {
    const auto along = along_tangent(grip, ray);
    if (!along) return {};
    return (*along - grip.along) / grip.ring.radius;
  }
  const auto point = on_plane(ray, grip.ring.center, grip.ring.axis);
  if (!point) return {};
  const vec3 from = *point - grip.ring.center;
  return std::atan2(glm::dot(from, glm::cross(grip.ring.axis, grip.grabbed)), glm::dot(from, grip.grabbed));
}

mat4 turned_about(const mat4& world, const vec3& axis, float angle) {
  mat4 out = glm::mat4_cast(glm::angleAxis(angle, axis)) * world;
  out[3] = world[3];
  return out;
}

float in_steps(float value, float step) {
  return step > 0 ? std::round(value / step) * step : value;
}

vec3 in_steps(const vec3& place, int axis, float step) {
  vec3 out = place;
  for (int i = 0; i < 3; ++i) {
    if (axis < 0 || axis == i) out[i] = in_steps(place[i], step);
  }
  return out;
}

PanTilt pan_tilt_of(const vec3& direction) {
  const vec3 d = glm::normalize(direction);
  const float level = std::hypot(d.x, d.z);
  return {level < 1e-4f ? 0 : glm::degrees(std::atan2(-d.x, -d.z)), glm::degrees(std::atan2(d.y, level))};
}

vec3 direction_of(const PanTilt& angles) {
  const float pan = glm::radians(angles.pan), tilt = glm::radians(angles.tilt);
  return {-std::sin(pan) * std::cos(tilt), std::sin(tilt), -std::cos(pan) * std::cos(tilt)};
}

}  // namespace ssphh::viewer
