#include "beam.h"

#include <algorithm>
#include <cmath>

namespace ssphh::sketch {

Beam Beam::of(const Eye& eye, const vec4& rectangle, float margin, bool parallel) {
  // Just within the edges: beyond some the next face of a cube begins.
  constexpr float inset = 1e-3f;
  const float x0 = rectangle.x + inset, y0 = rectangle.y + inset, x1 = rectangle.z - inset,
              y1 = rectangle.w - inset;
  const float xs[] = {x0, 0.5f * (x0 + x1), x1}, ys[] = {y0, 0.5f * (y0 + y1), y1};
  Beam beam{.axis = eye.ray(xs[1], ys[1])};
  float widest = 0;
  for (const float x : xs) {
    for (const float y : ys) {
      const Ray ray = eye.ray(x, y);
      const vec3 off = ray.origin - beam.axis.origin;
      beam.radius =
          std::max(beam.radius, glm::length(off - glm::dot(off, beam.axis.direction) * beam.axis.direction));
      const float sine = glm::length(glm::cross(ray.direction, beam.axis.direction));
      widest = std::max(widest, std::atan2(sine, glm::dot(ray.direction, beam.axis.direction)));
    }
  }
  // Edges of a rectangle bulge between the rays looked at where a projection bends them.
  constexpr float bulge = 1.1f, most = 1.3f;
  const float angle = bulge * widest + (parallel ? 0 : margin);
  beam.bounded = angle < most;
  if (beam.bounded) beam.tangent = std::tan(angle);
  beam.radius = bulge * beam.radius + (parallel ? margin : 0);
  return beam;
}

bool Beam::meets_ball(const vec3& center, float ball_radius) const {
  if (!bounded) return true;
  const vec3 p = center - axis.origin;
  const float along = glm::dot(p, axis.direction);
  const float off = glm::length(p - along * axis.direction);
  return off - along * tangent <= radius + ball_radius * std::sqrt(1 + tangent * tangent);
}

bool Beam::meets_line(const vec3& a, const vec3& b) const {
  if (!bounded) return true;
  // |q + t e| − tangent (z + t dz) is convex in t; its least value tells.
  const vec3 p = a - axis.origin, d = b - a;
  const float z = glm::dot(p, axis.direction), dz = glm::dot(d, axis.direction);
  const vec3 q = p - z * axis.direction, e = d - dz * axis.direction;
  const auto off = [&](float t) { return glm::length(q + t * e) - tangent * (z + t * dz); };
  float least = std::min(off(0), off(1));
  const float e2 = glm::dot(e, e), k = tangent * dz;
  if (k * k < e2) {
    const float middle = -glm::dot(q, e) / e2;
    const float t = middle + k * glm::length(q + middle * e) / std::sqrt(e2 * (e2 - k * k));
    least = std::min(least, off(std::clamp(t, 0.0f, 1.0f)));
  }
  return least <= radius;
}

}  // namespace ssphh::sketch
