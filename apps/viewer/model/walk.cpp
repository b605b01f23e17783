#include "walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ssphh::viewer {
namespace {

constexpr vec3 up(0, 1, 0);

/// How far a ray goes before it meets something, and the normal there; none: `reach`.
std::optional<rays::RayHit> met(const rays::PosedWorld& world, const vec3& origin, const vec3& direction,
                                float reach) {
  const rays::RayQuery ray{origin, direction, reach};
  rays::RayHit hit;
  world.intersect({&ray, 1}, {&hit, 1});
  if (hit.escaped() || hit.distance > reach) return {};
  return hit;
}

vec3 on_level(const vec3& v) {
  const vec3 level(v.x, 0, v.z);
  const float length = glm::length(level);
  return length > 1e-4f ? level / length : vec3(0);
}

/// A body at its eye.
struct Body {
  const Walker& walker;
  const rays::PosedWorld& world;

  std::array<vec3, 5> around(const vec3& eye, float radius) const {
    return {eye, eye + vec3(radius, 0, 0), eye - vec3(radius, 0, 0), eye + vec3(0, 0, radius),
            eye - vec3(0, 0, radius)};
  }

  struct Wall {
    float free;   ///< way until the body touches it
    vec3 normal;  ///< on the level, toward the body
  };
  /// What the body touches first on a way, between the height of a step and its eye.
  std::optional<Wall> wall(const vec3& eye, const vec3& direction, float length) const {
    const vec3 aside = walker.radius() * 0.9f * glm::cross(direction, up);
    std::optional<Wall> first;
    for (const float height : {1.02f * walker.step(), 0.6f * walker.eye, walker.eye}) {
      for (const float side : {-1.0f, 0.0f, 1.0f}) {
        const vec3 from = eye + (height - walker.eye) * up + side * aside;
        const auto hit = met(world, from, direction, length + 3 * walker.radius());
        if (!hit) continue;
        vec3 normal = on_level(hit->normal);
        if (normal == vec3(0)) normal = -direction;
        if (glm::dot(normal, direction) > 0) normal = -normal;
        const float slope = std::max(-glm::dot(normal, direction), 1e-3f);
        const float apart = glm::dot(eye - (from + hit->distance * direction), normal);
        const float free = std::max((apart - walker.radius()) / slope, 0.0f);
        if (free < length && (!first || free < first->free)) first = {free, normal};
      }
    }
    return first;
  }

  /// Whether a table, or a low ceiling, stands in it.
  bool obstructed(const vec3& eye) const {
    for (const vec3& from : around(eye, 0.8f * walker.radius())) {
      if (!world.visible(from, from - (walker.eye - 1.02f * walker.step()) * up)) return true;
    }
    return !world.visible(eye, eye + 0.04f * walker.eye * up);
  }

  /// Height of the ground below; the highest within the body's width.
  std::optional<float> ground(const vec3& eye) const {
    std::optional<float> highest;
    const float reach = std::max(eye.y - world.bounds().min.y, 0.0f) + walker.eye;
    for (const vec3& place : around(eye, 0.5f * walker.radius())) {
      const vec3 from = place - (walker.eye - walker.step()) * up;
      const auto hit = met(world, from, -up, reach);
      // Nothing may be below the middle alone
      if (!hit && place == eye) return {};
      if (hit) highest = std::max(highest.value_or(-1e30f), from.y - hit->distance);
    }
    return highest;
  }

  /// Away from walls that are nearer than the body is wide; what comes from both sides cancels.
  vec3 pushed(const vec3& eye) const {
    vec3 push(0);
    for (int i = 0; i < 8; ++i) {
      const float angle = static_cast<float>(i) * pi / 4;
      const vec3 direction(std::cos(angle), 0, std::sin(angle));
      for (const float height : {1.02f * walker.step(), 0.6f * walker.eye, walker.eye}) {
        const auto hit = met(world, eye + (height - walker.eye) * up, direction, walker.radius());
        if (!hit) continue;
        const vec3 away = -(walker.radius() - hit->distance) * direction;
        for (const int axis : {0, 2}) {
          if (std::abs(away[axis]) > std::abs(push[axis]) || away[axis] * push[axis] < 0)
            push[axis] = away[axis] * push[axis] < 0 ? push[axis] + away[axis] : away[axis];
        }
      }
    }
    return eye + push;
  }

  /// On the level, up to walls and along them.
  vec3 slid(vec3 eye, vec3 way) const {
    vec3 before(0);
    for (int turn = 0; turn < 3; ++turn) {
      const float length = glm::length(way);
      if (length < 1e-6f * walker.eye) break;
      const vec3 direction = way / length;
      const auto hit = wall(eye, direction, length);
      if (!hit) return eye + way;
      eye += hit->free * direction;
      const vec3 normal = hit->normal;
      way = (length - hit->free) * (direction - glm::dot(direction, normal) * normal);
      // In a corner there is no way along both walls.
      if (glm::dot(way, before) < 0) break;
      before = normal;
    }
    return eye;
  }

  bool may_stand(const vec3& from, const vec3& to) const {
    const vec3 low = (0.4f * walker.eye) * up;
    return world.visible(from, to) && world.visible(from - low, to - low) && ground(to) &&
           (!obstructed(to) || obstructed(from));
  }
};

/// Where a ceiling keeps the walker from standing up it goes on as high as it is.
Walker bent(const View& view, const Walker& walker, const rays::PosedWorld& world) {
  const auto below = met(world, view.eye, -up, walker.eye);
  if (!below) return walker;
  const float lacks = walker.eye - below->distance;
  const bool low = lacks > 0.02f * walker.eye && met(world, view.eye, up, lacks + 0.06f * walker.eye);
  return low ? Walker{std::max(below->distance, 0.1f * walker.eye)} : walker;
}

}  // namespace

Walker walker_for(const scene::Bounds& bounds) {
  Walker walker;
  if (!bounds.empty()) walker.eye = std::min(walker.eye, 0.6f * (bounds.max.y - bounds.min.y));
  walker.eye = std::max(walker.eye, 1e-5f);
  return walker;
}

std::optional<View> above_ground(const View& view, const rays::PosedWorld& world) {
  constexpr int places = 32;
  const auto ahead = met(world, view.eye, view.forward(), 1e30f);
  const vec3 step = (ahead ? ahead->distance / places : 0.0f) * view.forward();
  View out = view;
  for (int i = 0; i < places; ++i, out.eye += step) {
    if (met(world, out.eye, -up, 1e30f)) return out;
  }
  return {};
}

std::optional<View> stood(const View& view, const Walker& walker, const rays::PosedWorld& world) {
  View out = view.orthographic ? with_other_projection(view) : view;
  const float reach = std::max(out.eye.y - world.bounds().min.y, 0.0f) + walker.eye;
  const auto below = met(world, out.eye, -up, reach);
  if (!below) return {};
  const vec3 feet = out.eye - below->distance * up;
  const auto above = met(world, feet + 0.1f * walker.eye * up, up, walker.eye);
  const float room = above ? above->distance + 0.05f * walker.eye : walker.eye;
  out.eye = feet + std::min(room, walker.eye) * up;
  return out;
}

View walked(const View& view, const vec2& way, const Walker& walker, const rays::PosedWorld& world,
            float seconds) {
  const Body body{bent(view, walker, world), world};
  View out = view;
  const vec3 right = on_level(view.right()), forward = on_level(glm::cross(up, right));
  const vec3 wanted = way.x * right + way.y * forward;
  for (const vec3& part : {wanted, vec3(wanted.x, 0, 0), vec3(0, 0, wanted.z)}) {
    if (part == vec3(0)) continue;
    const vec3 there = body.pushed(body.slid(view.eye, part));
    if (!body.may_stand(view.eye, there)) continue;
    out.eye = there;
    break;
  }
  const auto ground = body.ground(out.eye);
  if (!ground) return out;
  const float rise = *ground + walker.eye - out.eye.y, climb = 3 * walker.eye * seconds;
  // Who stands stands still: where the ground is found hangs on the eye's last digits.
  if (std::abs(rise) < 1e-4f * walker.eye) return out;
  float by = std::clamp(rise, -2 * climb, climb);
  if (by > 0) {
    const auto ceiling = met(world, out.eye, up, by + 0.06f * walker.eye);
    if (ceiling) by = std::max(ceiling->distance - 0.06f * walker.eye, 0.0f);
  }
  out.eye.y += by;
  return out;
}

}  // namespace ssphh::viewer
