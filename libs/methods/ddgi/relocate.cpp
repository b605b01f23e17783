#include "relocate.h"

#include <limits>

#include <ssphh/core/sphere.h>

namespace ssphh::methods::ddgi {
namespace {

constexpr int fixed_rays = 32;
constexpr float back_limit = 0.25f;      // share of rays
constexpr float reach = 0.45f;           // of the spacing
constexpr float clearance_share = 0.1f;  // of the least spacing

/// What a probe's fixed rays meet.
struct Surroundings {
  float back_share = 0;
  float back = std::numeric_limits<float>::infinity(), front = back;  ///< nearest of each [m]
  float farthest = 0;                                                 ///< front, or nothing
  vec3 to_back{0}, to_front{0}, to_farthest{0};
};

Surroundings look_around(std::span<const rays::RayHit> hits, std::span<const vec3> directions) {
  Surroundings seen;
  int backs = 0;
  for (std::size_t r = 0; r < hits.size(); ++r) {
    if (hits[r].back) {
      ++backs;
      if (hits[r].distance < seen.back) seen.back = hits[r].distance, seen.to_back = directions[r];
      continue;
    }
    if (hits[r].distance < seen.front) seen.front = hits[r].distance, seen.to_front = directions[r];
    if (hits[r].distance > seen.farthest) seen.farthest = hits[r].distance, seen.to_farthest = directions[r];
  }
  seen.back_share = static_cast<float>(backs) / static_cast<float>(hits.size());
  return seen;
}

/// Where the probe would rather stand, as an offset from its place on the grid.
vec3 better_offset(const vec3& offset, const Surroundings& seen, float clearance) {
  if (seen.back_share > back_limit) return offset + seen.to_back * (seen.back + 0.5f * clearance);
  if (seen.front < clearance) {
    // Only with free way ahead, so that it does not swing between two walls.
    if (glm::dot(seen.to_front, seen.to_farthest) > 0) return offset;
    return offset + seen.to_farthest * std::min(clearance, 0.5f * seen.farthest);
  }
  const float home = glm::length(offset), free = seen.front - clearance;
  return home > 0 ? offset * std::max(1 - free / home, 0.0f) : offset;
}

std::vector<Surroundings> look_around(const std::vector<vec3>& positions, const rays::PosedWorld& surfaces,
                                      const std::vector<vec3>& directions) {
  std::vector<rays::RayQuery> rays;
  for (const vec3& position : positions) {
    for (const vec3& direction : directions) rays.push_back({position, direction});
  }
  std::vector<rays::RayHit> hits(rays.size());
  surfaces.intersect(rays, hits);
  std::vector<Surroundings> seen;
  for (std::size_t i = 0; i < positions.size(); ++i)
    seen.push_back(look_around(std::span(hits).subspan(i * fixed_rays, fixed_rays), directions));
  return seen;
}

}  // namespace

std::size_t relocate(DdgiField& field, const rays::PosedWorld& surfaces, int steps, bool move,
                     std::span<std::uint8_t> fresh) {
  std::vector<vec3> directions;
  for (int i = 0; i < fixed_rays; ++i) directions.push_back(spherical_fibonacci(i, fixed_rays));
  const float clearance = clearance_share * field.grid.least_spacing();
  std::vector<Surroundings> seen = look_around(field.position, surfaces, directions);
  std::size_t rays = field.position.size() * directions.size();
  for (int step = 0; move && step < steps; ++step) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const vec3 home = field.grid.position(static_cast<int>(i));
      const vec3 offset = better_offset(field.position[i] - home, seen[i], clearance);
      if (glm::length(offset / field.grid.spacing) < reach) field.position[i] = home + offset;
    }
    seen = look_around(field.position, surfaces, directions);
    rays += field.position.size() * directions.size();
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::uint8_t active = seen[i].back_share > back_limit ? 0 : 1;
    if (active && !field.active[i]) fresh[i] = 1;
    field.active[i] = active;
  }
  return rays;
}

}  // namespace ssphh::methods::ddgi
