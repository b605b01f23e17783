#include "beam.h"

#include <algorithm>
#include <cmath>

namespace ssphh::sketch {

Beam Beam::of(const Eye& eye, float x0, float y0, float x1, float y1, float margin) {
  Beam beam{.axis = eye.ray(0.5f * (x0 + x1), 0.5f * (y0 + y1))};
  const float xs[] = {x0 - margin, 0.5f * (x0 + x1), x1 + margin},
              ys[] = {y0 - margin, 0.5f * (y0 + y1), y1 + margin};
  float least_cosine = 1;
  for (const float x : xs) {
    for (const float y : ys) {
      const Ray ray = eye.ray(x, y);
      const vec3 off = ray.origin - beam.axis.origin;
      beam.radius =
          std::max(beam.radius, glm::length(off - glm::dot(off, beam.axis.direction) * beam.axis.direction));
      least_cosine = std::min(least_cosine, glm::dot(ray.direction, beam.axis.direction));
    }
  }
  // Edges of a rectangle bulge between the rays looked at where a projection bends them.
  constexpr float widest = 0.2f, bulge = 1.1f;
  beam.bounded = least_cosine > widest;
  if (beam.bounded)
    beam.tangent = bulge * std::sqrt(std::max(1 - least_cosine * least_cosine, 0.0f)) / least_cosine;
  beam.radius *= bulge;
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
