#include "rays.h"

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "points_in_reach.h"

namespace ssphh::methods::ddgi {
namespace {

constexpr std::size_t rays_per_batch = 1u << 15, lookup_grain = 128;

/// Rays to shade, with what they met.
struct Met {
  std::vector<rays::SurfacePoint> point;
  std::vector<vec3> albedo, wo;
  std::vector<std::size_t> ray;
};

}  // namespace

std::vector<vec3> ray_directions(int count, std::uint64_t seed, std::uint64_t frame) {
  // A uniform rotation is a uniform quaternion (Shoemake, Uniform Random Rotations, Graphics Gems III, 1992).
  Pcg32 random(seed, frame);
  const vec3 u = random.uniform3();
  const vec2 a = std::sqrt(1 - u.x) * unit_circle(u.y), b = std::sqrt(u.x) * unit_circle(u.z);
  const quat turn(b.x, a.x, a.y, b.y);
  std::vector<vec3> directions;
  for (int i = 0; i < count; ++i) directions.push_back(glm::normalize(turn * spherical_fibonacci(i, count)));
  return directions;
}

std::vector<ProbeRay> trace_probes(const DdgiField& field, const rays::PosedWorld& surfaces,
                                   const rays::DirectLight& lights, std::span<const vec3> group_scales,
                                   std::span<const vec3> directions, const Control& control) {
  std::vector<vec3> origins;
  for (std::size_t i = 0; i < field.active.size(); ++i) {
    if (field.active[i]) origins.push_back(field.position[i]);
  }
  std::vector<ProbeRay> result(origins.size() * directions.size());
  std::vector<rays::RayQuery> rays;
  std::vector<rays::RayHit> hits;
  for (std::size_t begin = 0; begin < result.size(); begin += rays_per_batch) {
    control.check();
    const std::size_t end = std::min(begin + rays_per_batch, result.size());
    rays.clear();
    for (std::size_t i = begin; i < end; ++i)
      rays.push_back({origins[i / directions.size()], directions[i % directions.size()]});
    hits.resize(rays.size());
    surfaces.intersect(rays, hits);

    Met met;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      result[begin + i].distance = hits[i].distance;
      if (hits[i].escaped() || !(max_component(hits[i].albedo) > 0)) continue;
      met.point.push_back({rays[i].origin + hits[i].distance * rays[i].direction, hits[i].normal});
      met.albedo.push_back(hits[i].through * hits[i].albedo);
      met.wo.push_back(-rays[i].direction);
      met.ray.push_back(begin + i);
    }
    const std::vector<vec3> direct = scaled_direct(lights, group_scales, met.point);
    parallel_for(met.point.size(), lookup_grain, [&](std::size_t i) {
      const rays::SurfacePoint& at = met.point[i];
      const vec3 indirect = field.irradiance(at.position, at.normal, met.wo[i], at.normal);
      result[met.ray[i]].radiance = met.albedo[i] / pi * (direct[i] + indirect);
    });
  }
  return result;
}

}  // namespace ssphh::methods::ddgi
