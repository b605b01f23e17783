#include "sphl_emission.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::transport {
namespace {

vec3 evaluate(const sh::RadianceSh& function, const vec3& direction) {
  std::array<float, sh::max_coefficient_count> basis;
  sh::eval_basis(function.degree(), direction, basis);
  vec3 sum(0);
  for (std::size_t k = 0; k < function.values.size(); ++k) sum += basis[k] * function.values[k];
  return glm::max(sum, vec3(0));
}

/// The way to the sphere's surface: what stands inside does not shadow the light that stands for it.
rays::RayQuery to_sphere(const vec3& from, const SphlEmitter& emitter) {
  const vec3 way = emitter.position - from;
  const float distance = glm::length(way);
  return {from, way, distance > emitter.radius ? 1 - emitter.radius / distance : 0};
}

}  // namespace

bool sees(const TransportNetwork& network, const rays::TransportSource& source, const vec3& a,
          const vec3& b) {
  return rays::PosedWorld(source, network.poses()).visible(a, b);
}

bool sees(const TransportNetwork& network, const rays::TransportSource& source, const vec3& from,
          const SphlEmitter& emitter) {
  return !rays::PosedWorld(source, network.poses()).occluded(to_sphere(from, emitter));
}

std::size_t add_emission(const TransportNetwork& network, const rays::TransportSource& source,
                         const SphlEmitter& emitter, std::span<vec3> samples) {
  if (emitter.leaving.empty()) return 0;
  std::vector<rays::RayQuery> segments;
  std::vector<std::size_t> which;
  const float lift = network.surfels().lift() * 0.05f;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const rays::SurfacePoint& p = network.samples()[i];
    const vec3 to_light = emitter.position - p.position;
    if (!network.sample_exists(i) || !(glm::dot(to_light, p.normal) > 0)) continue;
    const vec3 origin = p.position + lift * p.normal;
    segments.push_back(to_sphere(origin, emitter));
    which.push_back(i);
  }
  std::vector<std::uint8_t> blocked(segments.size());
  rays::PosedWorld(source, network.poses()).occluded(segments, blocked);
  parallel_for(which.size(), 256, [&](std::size_t k) {
    if (blocked[k]) return;
    const rays::SurfacePoint& p = network.samples()[which[k]];
    const vec3 to_light = emitter.position - p.position;
    const float distance = glm::length(to_light);
    const vec3 wi = to_light / distance;
    const float ratio = emitter.radius / std::max(distance, emitter.radius);
    samples[which[k]] += pi * ratio * ratio * glm::dot(wi, p.normal) * evaluate(emitter.leaving, -wi);
  });
  return segments.size();
}

float sphere_share(const vec3& from, const SphlEmitter& emitter) {
  const float distance = glm::distance(from, emitter.position);
  if (distance <= emitter.radius) return 1;
  const double sine = double(emitter.radius) / double(distance), sin2 = sine * sine;
  return static_cast<float>(0.5 * sin2 / (1 + std::sqrt(1 - sin2)));  // without cancellation
}

std::vector<float> visible_shares(const TransportNetwork& network, const rays::TransportSource& source,
                                  std::span<const vec3> from, const SphlEmitter& emitter) {
  constexpr std::size_t rays = 16;
  std::vector<rays::RayQuery> segments;
  for (const vec3& p : from) {
    const vec3 to_light = emitter.position - p;
    const float distance = glm::length(to_light), share = sphere_share(p, emitter);
    for (std::size_t r = 0; r < rays; ++r) {
      if (share == 1) {
        segments.push_back({p, vec3(0, 1, 0), 0});
        continue;
      }
      // A Fibonacci spiral, uniform over the cone; each ray ends at the sphere's surface.
      const float below = 2 * share * (static_cast<float>(r) + 0.5f) / static_cast<float>(rays);
      const float cosine = 1 - below, sine2 = below * (2 - below);
      const float half_chord =
          std::sqrt(std::max(emitter.radius * emitter.radius - distance * distance * sine2, 0.0f));
      const float turn = 0.38196601f * static_cast<float>(r);
      const vec3 local(std::sqrt(sine2) * unit_circle(turn - std::floor(turn)), cosine);
      segments.push_back(
          {p, Frame::around(to_light / distance).to_world(local), distance * cosine - half_chord});
    }
  }
  std::vector<std::uint8_t> blocked(segments.size());
  rays::PosedWorld(source, network.poses()).occluded(segments, blocked);
  std::vector<float> shares;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto first = blocked.begin() + static_cast<std::ptrdiff_t>(i * rays);
    shares.push_back(static_cast<float>(std::count(first, first + rays, 0)) / static_cast<float>(rays));
  }
  return shares;
}

void add_seen_emission(const vec3& probe, const SphlEmitter& emitter, sh::RadianceSh& out) {
  const vec3 to_light = emitter.position - probe;
  const float distance = glm::length(to_light);
  if (emitter.leaving.empty() || !(distance > 0)) return;
  const vec3 direction = to_light / distance;
  const double edge = 1 - 2 * double(sphere_share(probe, emitter));
  const sh::ZonalSh disc = sh::zonal_from_function(
      out.degree(), [](double) { return 1.0; }, edge);
  std::vector<float> lobe(out.values.size());
  sh::rotate_zonal(disc, direction, lobe);
  const vec3 radiance = evaluate(emitter.leaving, -direction);
  for (std::size_t k = 0; k < lobe.size(); ++k) out.values[k] += lobe[k] * radiance;
}

}  // namespace ssphh::transport
