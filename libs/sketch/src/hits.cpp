#include "hits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <ssphh/sh/reconstruct.h>

namespace ssphh::sketch {
namespace {

/// By a lamp at the eye: bright where a surface faces it.
vec3 shaded(const vec3& color, const vec3& normal, const vec3& direction) {
  return (0.25f + 0.75f * std::max(-glm::dot(normal, direction), 0.0f)) * color;
}

/// Where the ray enters and leaves a ball around the origin of `p`; entered behind the eye: nowhere.
std::optional<vec2> through_ball(const vec3& p, const vec3& direction, float radius) {
  const float b = glm::dot(p, direction);
  const vec3 off = p - b * direction;
  const float h2 = radius * radius - glm::dot(off, off);
  if (h2 <= 0) return {};
  const float h = std::sqrt(h2);
  if (-b - h <= 0) return {};
  return vec2(-b - h, -b + h);
}

}  // namespace

std::optional<Hit> hit(const Line& line, const Ray& ray, float pixel, bool parallel) {
  const vec3 &k = ray.direction, p = line.a - ray.origin, d = line.b - line.a;
  const float z = glm::dot(p, k), dz = glm::dot(d, k);
  // Only what lies before the eye counts.
  constexpr float nearest = 1e-4f;
  float from = 0, to = 1;
  if (z < nearest && z + dz < nearest) return {};
  if (z < nearest) from = (nearest - z) / dz;
  if (z + dz < nearest) to = (nearest - z) / dz;
  const float pd = glm::dot(p, d), pp = glm::dot(p, p), dd = glm::dot(d, d);
  const float above = parallel ? dz * z - pd : z * pd - pp * dz;
  const float below = parallel ? dd - dz * dz : dz * pd - z * dd;
  float best = std::numeric_limits<float>::infinity(), distance = 0;
  for (const float t : {from, to, below != 0 ? std::clamp(above / below, from, to) : from}) {
    const vec3 at = p + t * d;
    const float along = glm::dot(at, k), off = glm::length(at - along * k);
    const float deviation = parallel ? off : off / std::max(along, nearest);
    if (deviation < best) best = deviation, distance = along;
  }
  if (!(best <= 0.5f * line.width * pixel)) return {};
  const float slack = parallel ? line.width * pixel : line.width * pixel * distance;
  return Hit{distance, line.color, false, slack};
}

std::optional<Hit> hit(const Disc& disc, const Ray& ray) {
  const float cosine = glm::dot(disc.normal, ray.direction);
  if (cosine == 0) return {};
  const float distance = glm::dot(disc.center - ray.origin, disc.normal) / cosine;
  const float off = glm::length(ray.origin + distance * ray.direction - disc.center) / disc.radius;
  if (!(distance > 0) || !(off <= 1)) return {};
  constexpr float rim = 0.86f, dark = 0.25f;
  return Hit{distance, (off > rim ? dark : 1) * disc.color, disc.light, 0.1f * disc.radius};
}

std::optional<Hit> hit(const Box& box, const Ray& ray) {
  float enter = 0, leave = std::numeric_limits<float>::infinity();
  int side = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / ray.direction[axis];
    float near = (box.min[axis] - ray.origin[axis]) * inverse,
          far = (box.max[axis] - ray.origin[axis]) * inverse;
    int met = 2 * axis + 1;
    if (near > far) std::swap(near, far), met = 2 * axis;
    if (near > enter) enter = near, side = met;
    leave = std::min(leave, far);
  }
  if (side < 0 || !(enter < leave)) return {};
  return Hit{enter, box.colors[side], box.light, 0};
}

std::optional<Hit> hit(const Ball& ball, const Ray& ray) {
  const vec3 p = ray.origin - ball.center;
  const std::optional<vec2> through = through_ball(p, ray.direction, ball.radius);
  if (!through) return {};
  const vec3 normal = glm::normalize(p + through->x * ray.direction);
  if (ball.light.empty()) return Hit{through->x, shaded(ball.color, normal, ray.direction), false, 0};
  return Hit{through->x, glm::max(sh::eval(ball.light, normal), vec3(0)), true, 0};
}

std::optional<Hit> hit(const Lobe& lobe, const LobeTable& table, const Ray& ray) {
  const vec3 p = ray.origin - lobe.center;
  const float radius = lobe.scale * table.most();
  const std::optional<vec2> through = through_ball(p, ray.direction, radius);
  if (!through) return {};
  const auto outside = [&](const vec3& q) { return glm::length(q) - lobe.scale * std::abs(table.at(q)); };
  constexpr int steps = 96;
  const float step = 2 * radius / steps;
  float before = through->x;
  for (float t = before + step; before < through->y; before = t, t += step) {
    const vec3 q = p + t * ray.direction;
    if (glm::dot(q, q) == 0 || outside(q) > 0) continue;
    float after = t;
    for (int halved = 0; halved < 12; ++halved) {
      const float middle = 0.5f * (before + after);
      (outside(p + middle * ray.direction) > 0 ? before : after) = middle;
    }
    const vec3 at = p + after * ray.direction;
    const float h = 0.02f * std::max(glm::length(at), 0.05f * radius);
    vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      vec3 to(0);
      to[axis] = h;
      gradient[axis] = outside(at + to) - outside(at - to);
    }
    const float length = glm::length(gradient);
    const vec3 normal = length > 0 ? gradient / length : -ray.direction;
    const vec3& color = table.at(at) >= 0 ? lobe.positive : lobe.negative;
    return Hit{after, shaded(color, normal, ray.direction), false, 0.05f * radius};
  }
  return {};
}

}  // namespace ssphh::sketch
