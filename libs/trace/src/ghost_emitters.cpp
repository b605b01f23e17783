#include "ghost_emitters.h"

#include <ssphh/core/sphere.h>

namespace ssphh::trace {

std::optional<shading::LightSample> GhostEmitters::sample(int, const PathVertex& vertex, float u_choice,
                                                          const vec2& u) const {
  const float total = total_weight(vertex);
  if (!(total > 0)) return std::nullopt;

  // Choose a ball; rounding at the end of the sum falls to the last possible one.
  float rest = u_choice * total, chosen_weight = 0;
  std::size_t chosen = 0;
  for (std::size_t j = 0; j < balls_.size(); ++j) {
    const float w = weight(balls_[j], vertex);
    if (!(w > 0)) continue;
    chosen = j, chosen_weight = w;
    if (rest < w) break;
    rest -= w;
  }
  const Ball& ball = balls_[chosen];
  shading::LightSample sample;
  sample.wi = sample_cone(ball, vertex.position, u, sample.distance);
  sample.radiance = vec3(1);
  sample.pdf = chosen_weight / (total * cone_solid_angle(ball, vertex.position));
  sample.delta = false;
  sample.group = static_cast<int>(chosen);
  return sample;
}

bool GhostEmitters::meets(const Ball& ball, const Ray& ray, float distance) {
  if (!(ball.radius > 0)) return false;
  const vec3 to_center = ball.center - ray.origin;
  const float r2 = ball.radius * ball.radius;
  if (glm::dot(to_center, to_center) <= r2) return true;
  const float along = glm::dot(to_center, ray.direction);
  if (along <= 0) return false;
  const vec3 across = to_center - along * ray.direction;
  const float across2 = glm::dot(across, across);
  return across2 <= r2 && along - std::sqrt(r2 - across2) < distance;
}

namespace {

/// 1 − cos of the cone's half angle, without cancellation; `sin2` = (radius/distance)².
float one_minus_cos(float sin2) {
  return sin2 / (1 + std::sqrt(std::max(0.0f, 1 - sin2)));
}

float sin2_of(const GhostEmitters::Ball& ball, const vec3& from) {
  const vec3 d = ball.center - from;
  return ball.radius * ball.radius / glm::dot(d, d);
}

}  // namespace

float GhostEmitters::cone_solid_angle(const Ball& ball, const vec3& from) {
  return 2 * pi * one_minus_cos(sin2_of(ball, from));
}

vec3 GhostEmitters::sample_cone(const Ball& ball, const vec3& from, const vec2& u, float& distance) {
  const vec3 to_center = ball.center - from;
  const float d = glm::length(to_center);
  const float q = u.x * one_minus_cos(sin2_of(ball, from));  // 1 − cos θ
  const float cos_theta = 1 - q, sin2 = q * (2 - q), sin_theta = std::sqrt(sin2);
  distance = d * cos_theta - std::sqrt(std::max(0.0f, ball.radius * ball.radius - d * d * sin2));
  const Frame frame = Frame::around(to_center / d);
  return frame.to_world({sin_theta * unit_circle(u.y), cos_theta});
}

float GhostEmitters::weight(const Ball& ball, const PathVertex& vertex) {
  if (!(ball.radius > 0)) return 0;
  const vec3 to_center = ball.center - vertex.position;
  const float d2 = glm::dot(to_center, to_center);
  const float sin2 = ball.radius * ball.radius / d2;
  if (!(sin2 < 1)) return 0;
  const float largest_cos = glm::dot(to_center, vertex.normal) / std::sqrt(d2) + std::sqrt(sin2);
  return largest_cos > 0 ? sin2 * largest_cos : 0;
}

float GhostEmitters::total_weight(const PathVertex& vertex) const {
  float total = 0;
  for (const Ball& ball : balls_) total += weight(ball, vertex);
  return total;
}

}  // namespace ssphh::trace
