#include "camera_path.h"

#include <algorithm>

namespace ssphh::viewer {
namespace {

float gap(const CameraPath& path, std::size_t i) {
  return path.keys[i + 1].time - path.keys[i].time;
}

vec3 slope(const CameraPath& path, std::size_t i) {
  return (path.keys[i + 1].view.eye - path.keys[i].view.eye) / gap(path, i);
}

/// Velocity at key i [m/s].
vec3 tangent(const CameraPath& path, std::size_t i) {
  const std::size_t last = path.keys.size() - 1;
  if (last == 1) return slope(path, 0);
  if (i == 0) return 2.0f * slope(path, 0) - tangent(path, 1);
  if (i == last) return 2.0f * slope(path, last - 1) - tangent(path, last - 1);
  const float before = gap(path, i - 1), after = gap(path, i);
  return (before * slope(path, i) + after * slope(path, i - 1)) / (before + after);
}

std::optional<float> mix(const std::optional<float>& a, const std::optional<float>& b, float s) {
  if (a && b) return glm::mix(*a, *b, s);
  return a ? a : b;
}

}  // namespace

CameraKey at(const CameraPath& path, float time) {
  SSPHH_CHECK(!path.keys.empty());
  const auto next = std::ranges::upper_bound(path.keys, time, {}, &CameraKey::time);
  if (next == path.keys.begin()) return path.keys.front();
  if (next == path.keys.end()) return path.keys.back();
  const auto i = static_cast<std::size_t>(next - path.keys.begin()) - 1;
  const CameraKey &a = path.keys[i], &b = path.keys[i + 1];
  if (time == a.time) return a;
  const float dt = gap(path, i), s = (time - a.time) / dt, s2 = s * s, s3 = s2 * s;

  CameraKey key = a;
  key.time = time;
  key.scene_time = mix(a.scene_time, b.scene_time, s);
  key.view.eye = (2 * s3 - 3 * s2 + 1) * a.view.eye + dt * (s3 - 2 * s2 + s) * tangent(path, i) +
                 (3 * s2 - 2 * s3) * b.view.eye + dt * (s3 - s2) * tangent(path, i + 1);
  key.view.orientation = glm::slerp(a.view.orientation, b.view.orientation, s);
  key.view.yfov = glm::mix(a.view.yfov, b.view.yfov, s);
  key.view.focus = glm::mix(a.view.focus, b.view.focus, s);
  key.view.yheight = glm::mix(a.view.yheight, b.view.yheight, s);
  return key;
}

void append(CameraPath& path, CameraKey key, float gap) {
  key.time = path.keys.empty() ? 0 : path.keys.back().time + gap;
  path.keys.push_back(std::move(key));
}

}  // namespace ssphh::viewer
