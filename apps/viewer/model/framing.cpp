#include "framing.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ssphh::viewer {
namespace {

/// The farthest place on the line from the middle of a sphere into `direction`, `most` away at most, whence
/// the sphere is seen, with a little room behind; `from`: that can be reached from there as well.
std::optional<float> place_on_line(const rays::PosedWorld& world, const vec3& center, float radius,
                                   const vec3& direction, float most, const vec3* from) {
  constexpr float step = 0.93f, room = 0.06f;
  for (float distance = most; distance > 0.05f * most; distance *= step) {
    const vec3 eye = center + distance * direction;
    const vec3 behind = eye + room * distance * direction;
    // Glass, too, is a wall to who goes, not to who looks on.
    if (from && !world.joined(*from, behind)) continue;
    // What is within the sphere is the thing itself, or as near as it.
    const float free = distance - radius;
    const vec3 near = free > 0 ? behind - (free + room * distance) * direction : eye;
    if (from ? !world.visible(behind, near) : !world.joined(behind, near)) continue;
    return distance;
  }
  return {};
}

View placed(const View& view, const vec3& center, const vec3& direction, float distance, bool turns) {
  View out = turns ? look_at(center + distance * direction, center, view.yfov) : view;
  out.orthographic = view.orthographic, out.yheight = view.yheight;
  out.focus = distance;
  out.eye = center + distance * direction;
  return out;
}

}  // namespace

View framed_within(const View& view, const scene::Bounds& bounds, float aspect,
                   const rays::PosedWorld& world) {
  if (bounds.empty()) return view;
  const View whole = framed(view, bounds, aspect);
  const vec3 center = bounds.center(), now = -view.forward();
  const float radius = std::max(bounds.radius(), 1e-3f), apart = glm::distance(view.eye, center);
  const vec3 across = apart > 1e-4f ? (view.eye - center) / apart : now;
  View out = view;
  out.yheight = whole.yheight;
  for (const vec3* const from : {&view.eye, static_cast<const vec3*>(nullptr)}) {
    // A thing around the eye leaves no choice but where the eye is.
    if (!from && apart < radius) break;
    for (const vec3& direction : {now, across}) {
      const auto distance = place_on_line(world, center, radius, direction, whole.focus, from);
      if (distance) return placed(out, center, direction, *distance, direction != now);
    }
  }
  if (apart < 1e-4f) return out;
  View turned = look_at(view.eye, center, view.yfov);
  turned.orthographic = view.orthographic, turned.yheight = whole.yheight;
  return turned;
}

View orbited_about(const View& view, const vec3& point, float yaw, float pitch) {
  const vec3 from = point - view.eye;
  const float depth = glm::dot(from, view.forward());
  if (!(depth > 1e-4f)) return view;
  View out = turned(view, yaw, pitch);
  const quat turn = out.orientation * glm::conjugate(view.orientation);
  out.eye = point - turn * from;
  out.focus = depth;
  return out;
}

View orbited_within(const View& view, const vec3& point, float yaw, float pitch,
                    const rays::PosedWorld& world) {
  constexpr float step = 0.95f, room = 0.03f, least = 0.05f;
  View out = orbited_about(view, point, yaw, pitch);
  if (view.orthographic) return out;
  const vec3 eye = out.eye, away = eye - point;
  const float focus = out.focus;
  for (float share = 1; share > least; share *= step) {
    if (share < 1) out.eye = point + share * away, out.focus = share * focus;
    if (world.joined(view.eye, out.eye + room * share * away)) return out;
  }
  return view;
}

}  // namespace ssphh::viewer
