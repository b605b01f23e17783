#include "view_camera.h"

#include <algorithm>
#include <cmath>

namespace ssphh::viewer {
namespace {

struct Angles {
  float yaw, pitch;
};

Angles angles_of(const View& view) {
  const vec3 f = view.forward();
  const float pitch = std::asin(std::clamp(f.y, -1.0f, 1.0f));
  // Straight up or down only the picture's top tells where the viewer faces.
  const vec3 heading = std::abs(f.y) < 0.9999f ? f : -std::copysign(1.0f, f.y) * view.up();
  return {std::atan2(-heading.x, -heading.z), pitch};
}

quat orientation_of(const Angles& a) {
  return glm::angleAxis(a.yaw, vec3(0, 1, 0)) * glm::angleAxis(a.pitch, vec3(1, 0, 0));
}

}  // namespace

View view_of(const scene::CameraPose& pose, float distance) {
  View view;
  view.eye = vec3(pose.world[3]);
  const vec3 z = glm::normalize(vec3(pose.world[2]));
  const vec3 x = glm::normalize(glm::cross(vec3(pose.world[1]), z));
  view.orientation = glm::normalize(glm::quat_cast(mat3(x, glm::cross(z, x), z)));
  view.yfov = pose.camera.yfov;
  view.orthographic = pose.camera.orthographic;
  view.yheight = pose.camera.yheight;
  view.focus = distance;
  return view;
}

scene::CameraPose pose_of(const View& view) {
  scene::CameraPose pose;
  pose.world = glm::mat4_cast(view.orientation);
  pose.world[3] = vec4(view.eye, 1);
  pose.camera.name = "view";
  pose.camera.yfov = view.yfov;
  pose.camera.orthographic = view.orthographic;
  pose.camera.yheight = view.yheight;
  return pose;
}

View look_at(const vec3& eye, const vec3& target, float yfov) {
  View view;
  view.eye = eye;
  view.yfov = yfov;
  view.focus = std::max(glm::distance(eye, target), 1e-3f);
  const vec3 d = (target - eye) / view.focus;
  const float level = std::hypot(d.x, d.z);
  view.orientation =
      orientation_of({level > 0 ? std::atan2(-d.x, -d.z) : 0, std::asin(std::clamp(d.y, -1.0f, 1.0f))});
  return view;
}

View turned(const View& view, float yaw, float pitch) {
  Angles a = angles_of(view);
  const float limit = glm::radians(89.0f);
  a.yaw += yaw;
  a.pitch = std::clamp(a.pitch + pitch, -limit, limit);
  View out = view;
  out.orientation = orientation_of(a);
  return out;
}

View orbited(const View& view, float yaw, float pitch) {
  View out = turned(view, yaw, pitch);
  out.eye = view.center() - out.focus * out.forward();
  return out;
}

View moved(const View& view, const vec3& right_up_forward) {
  View out = view;
  out.eye += right_up_forward.x * view.right() + right_up_forward.y * view.up() +
             right_up_forward.z * view.forward();
  return out;
}

View dollied(const View& view, float factor) {
  View out = view;
  out.focus = std::max(view.focus * factor, 1e-3f);
  out.yheight = std::max(view.yheight * factor, 1e-3f);
  out.eye = view.center() - out.focus * view.forward();
  return out;
}

View seen_along(const View& view, const vec3& direction) {
  const vec3 center = view.center();
  const View turned = look_at(center - view.focus * glm::normalize(direction), center, view.yfov);
  View out = view;
  out.eye = turned.eye, out.orientation = turned.orientation;
  return out;
}

View with_other_projection(const View& view) {
  View out = view;
  out.orthographic = !view.orthographic;
  const float extent = 2 * std::tan(0.5f * view.yfov);
  if (out.orthographic) {
    out.yheight = view.focus * extent;
  } else {
    out.focus = std::max(view.yheight / extent, 1e-3f);
    out.eye = view.center() - out.focus * view.forward();
  }
  return out;
}

View framed(const View& view, const scene::Bounds& bounds, float aspect) {
  if (bounds.empty()) return view;
  View out = view;
  const float radius = std::max(bounds.radius(), 1e-3f);
  const float half = 0.5f * std::min(view.yfov, 2 * std::atan(aspect * std::tan(0.5f * view.yfov)));
  out.focus = radius / std::sin(std::max(half, 1e-3f));
  out.yheight = 2 * radius / std::min(aspect, 1.0f);
  out.eye = bounds.center() - out.focus * view.forward();
  return out;
}

rays::RayQuery pixel_ray(const View& view, const vec2& point, float aspect) {
  const vec2 centered = 2.0f * point - 1.0f;
  rays::RayQuery ray;
  if (view.orthographic) {
    const float h = 0.5f * view.yheight;
    ray.origin = view.eye + centered.x * h * aspect * view.right() + centered.y * h * view.up();
    ray.direction = view.forward();
  } else {
    const float h = std::tan(0.5f * view.yfov);
    ray.origin = view.eye;
    ray.direction =
        glm::normalize(view.forward() + centered.x * h * aspect * view.right() + centered.y * h * view.up());
  }
  return ray;
}

vec3 project(const View& view, const vec3& point, float aspect) {
  const vec3 local = glm::conjugate(view.orientation) * (point - view.eye);
  const float depth = -local.z;
  const float h = view.orthographic ? 0.5f * view.yheight : depth * std::tan(0.5f * view.yfov);
  return {0.5f + 0.5f * local.x / (h * aspect), 0.5f + 0.5f * local.y / h, depth};
}

}  // namespace ssphh::viewer
