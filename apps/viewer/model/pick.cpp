#include "pick.h"

#include <cmath>

#include <ssphh/rays/posed_world.h>

namespace ssphh::viewer {

int pick_sphere(const rays::RayQuery& ray, std::span<const vec4> spheres, float limit) {
  int best = -1;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const vec3 to = vec3(spheres[i]) - ray.origin;
    const float radius = spheres[i].w;
    const float along = glm::dot(to, ray.direction);
    const float off = glm::dot(to, to) - along * along;
    if (off > radius * radius) continue;
    const float t = along - std::sqrt(radius * radius - off);
    if (t <= 0 || t >= limit) continue;
    limit = t;
    best = static_cast<int>(i);
  }
  return best;
}

std::optional<rays::SurfacePoint> pick_surface(const rays::TransportSource& source, float time,
                                               const rays::RayQuery& ray) {
  rays::RayHit hit;
  rays::PosedWorld(source, time).intersect({&ray, 1}, {&hit, 1});
  if (hit.escaped()) return {};
  return rays::SurfacePoint{ray.origin + hit.distance * ray.direction, hit.normal};
}

std::optional<float> along_axis(const rays::RayQuery& ray, const vec3& origin, const vec3& axis) {
  const float b = glm::dot(axis, ray.direction);
  const float determinant = glm::dot(ray.direction, ray.direction) - b * b;
  if (determinant < 1e-6f) return {};
  const vec3 w = ray.origin - origin;
  return (glm::dot(w, axis) * glm::dot(ray.direction, ray.direction) - b * glm::dot(w, ray.direction)) /
         determinant;
}

vec3 on_ball(const rays::RayQuery& ray, const vec3& center, float radius) {
  const float along = glm::dot(center - ray.origin, ray.direction);
  const vec3 nearest = ray.origin + along * ray.direction - center;
  const float beside = glm::dot(nearest, nearest), rest = radius * radius - beside;
  if (rest < 0) return center + radius * glm::normalize(nearest);
  return center + nearest - std::sqrt(rest) * ray.direction;
}

std::optional<vec3> on_plane(const rays::RayQuery& ray, const vec3& point, const vec3& normal) {
  const float slope = glm::dot(ray.direction, normal);
  if (std::abs(slope) < 1e-6f) return {};
  const float t = glm::dot(point - ray.origin, normal) / slope;
  if (t <= 0) return {};
  return ray.origin + t * ray.direction;
}

}  // namespace ssphh::viewer
