#include "eye.h"

#include <cmath>

#include <ssphh/core/error.h>

namespace ssphh::realtime {

Eye eye_of(const scene::CameraPose& camera, const FrameSettings& settings, const FrameImages& images) {
  const scene::Camera& lens = camera.camera;
  const vec3 eye(camera.world[3]), right = glm::normalize(vec3(camera.world[0])),
                                   up = glm::normalize(vec3(camera.world[1])),
                                   forward = -glm::normalize(vec3(camera.world[2]));
  if (!is_finite(eye) || !is_finite(right) || !is_finite(up) || !is_finite(forward))
    throw Error("camera \"" + lens.name + "\"", "its pose is not finite or has no extent");
  const gl::Rect full = images.full();
  const auto width = static_cast<float>(full.width), height = static_cast<float>(full.height);
  const float half_height = lens.orthographic ? 0.5f * lens.yheight : std::tan(0.5f * lens.yfov);
  const float half_width = half_height * width / height;
  const vec2 shift = 2.0f * settings.shift * static_cast<float>(images.supersample) / vec2(width, height);
  return {eye, half_width * right, half_height * up, forward, shift, lens.orthographic};
}

Eye eye_of(const mat4& view_projection, float nearest_z, float farthest_z) {
  const glm::dmat4 m = glm::inverse(glm::dmat4(view_projection));
  const auto finite = [](const glm::dvec4& v) { return std::isfinite(glm::dot(v, v)); };
  if (!finite(m[0]) || !finite(m[1]) || !finite(m[2]) || !finite(m[3]))
    throw Error("G-buffer", "its view_projection cannot be inverted");
  // A place of clip space, over its w, is at x m[0] + y m[1] + z m[2] + m[3]
  Eye eye;
  glm::dvec3 origin, x, y, ahead;
  eye.orthographic = std::abs(m[2].w) < 1e-5 * std::abs(m[3].w);
  if (eye.orthographic) {
    const double w = m[3].w;
    x = glm::dvec3(m[0]) / w, y = glm::dvec3(m[1]) / w;
    const glm::dvec3 range = static_cast<double>(farthest_z - nearest_z) * glm::dvec3(m[2]) / w;
    // Before the nearest, whose depth is above 0 then
    origin = (glm::dvec3(m[3]) + static_cast<double>(nearest_z) * glm::dvec3(m[2])) / w - range;
    ahead = glm::normalize(range);
  } else {
    origin = glm::dvec3(m[2]) / m[2].w;
    const auto direction = [&](const glm::dvec4& v) { return glm::dvec3(v) - v.w * origin; };
    x = direction(m[0]), y = direction(m[1]);
    const glm::dvec3 middle = direction(m[3]);
    glm::dvec3 axis = glm::normalize(glm::cross(x, y));
    if (glm::dot(axis, middle) < 0) axis = -axis;
    const double scale = 1 / glm::dot(axis, middle);
    x *= scale, y *= scale, ahead = axis;
    const glm::dvec3 aside = scale * middle - axis;
    eye.shift = -glm::dvec2(glm::dot(aside, x) / glm::dot(x, x), glm::dot(aside, y) / glm::dot(y, y));
  }
  eye.position = origin, eye.right = x, eye.up = y, eye.forward = ahead;
  const bool upright = std::abs(glm::dot(x, y)) < 1e-3 * glm::length(x) * glm::length(y);
  if (!upright || !is_finite(eye.position) || !is_finite(eye.right) || !is_finite(eye.up) ||
      !is_finite(eye.forward) || !std::isfinite(eye.shift.x + eye.shift.y))
    throw Error("G-buffer", "its view_projection is none of a perspective or orthographic camera");
  return eye;
}

}  // namespace ssphh::realtime
