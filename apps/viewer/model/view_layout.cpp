#include "view_layout.h"

#include <algorithm>
#include <utility>

#include <ssphh/core/require.h>

namespace ssphh::viewer {
namespace {

/// The first or the second half of an area.
Rect2 half(const Rect2& area, bool second, bool beside) {
  constexpr float gap = 2;
  Rect2 out = area;
  float& at = beside ? out.x : out.y;
  float& size = beside ? out.width : out.height;
  const float part = std::max((size - gap) / 2, 1.0f);
  if (second) at += size - part;
  size = part;
  return out;
}

/// What of the scene is no farther on the level than 3.5 times the longest way to a wall: of a house on a
/// wide ground the house. All of it where there are no walls.
scene::Bounds around(const vec3& eye, const scene::Bounds& bounds, const rays::PosedWorld& world) {
  float longest = 0;
  for (const vec3 direction : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 0, 1), vec3(0, 0, -1)}) {
    const rays::RayQuery ray{eye, direction};
    rays::RayHit hit;
    world.intersect({&ray, 1}, {&hit, 1});
    if (!hit.escaped()) longest = std::max(longest, hit.distance);
  }
  if (longest == 0) return bounds;
  scene::Bounds near = bounds;
  for (const int axis : {0, 2}) {
    near.min[axis] = std::max(near.min[axis], eye[axis] - 3.5f * longest);
    near.max[axis] = std::min(near.max[axis], eye[axis] + 3.5f * longest);
  }
  return near.empty() ? bounds : near;
}

}  // namespace

Rect2 cell(const Rect2& area, int place, int count) {
  require(count >= 1 && count <= most_views && place >= 0 && place < count, "views",
          "there is no such place");
  if (count == 1) return area;
  const bool beside = area.width >= area.height;
  if (count == 4) return half(half(area, place >= 2, false), place % 2 == 1, true);
  const Rect2 part = half(area, place > 0, beside);
  return count == 2 || place == 0 ? part : half(part, place == 2, !beside);
}

vec3 first_direction(int place) {
  constexpr vec3 directions[] = {{0, -1, 0}, {0, 0, -1}, {-1, 0, 0}};
  return directions[std::clamp(place - 1, 0, 2)];
}

View section(const View& view, const vec3& direction, const scene::Bounds& whole, float aspect,
             const rays::PosedWorld& world) {
  const vec3 back = -glm::normalize(direction);
  View out = seen_along(view, direction);
  if (!out.orthographic) out = with_other_projection(out);
  if (whole.empty()) return out;
  const scene::Bounds bounds = around(view.eye, whole, world);
  const auto extent = [&](const vec3& axis) { return glm::dot(glm::abs(axis), bounds.max - bounds.min); };
  out = framed(out, bounds, aspect);
  out.yheight = 1.05f * std::max({extent(out.up()), extent(out.right()) / aspect, 1e-3f});
  const rays::RayQuery ray{view.eye, back};
  rays::RayHit hit;
  world.intersect({&ray, 1}, {&hit, 1});
  if (hit.escaped()) return out;
  const float too_far = glm::dot(out.eye - view.eye, back) - 0.98f * hit.distance;
  if (too_far > 0) {
    out.eye -= too_far * back;
    out.focus = std::max(out.focus - too_far, 0.02f * out.focus);
  }
  return out;
}

std::string view_name(const View& view) {
  if (!view.orthographic) return "perspective";
  const std::pair<vec3, const char*> sides[] = {{{0, -1, 0}, "top"},   {{0, 1, 0}, "bottom"},
                                                {{0, 0, -1}, "front"}, {{0, 0, 1}, "back"},
                                                {{-1, 0, 0}, "right"}, {{1, 0, 0}, "left"}};
  for (const auto& [direction, name] : sides) {
    if (glm::dot(view.forward(), direction) > 0.99999f) return name;
  }
  return "orthographic";
}

}  // namespace ssphh::viewer
