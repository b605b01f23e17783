#include "sphl_emission.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/zonal.h>

namespace ssphh::gi {
namespace {

vec3 evaluate(const sh::RadianceSh& function, const vec3& direction) {
  std::array<float, sh::max_coefficient_count> basis;
  sh::eval_basis(function.degree(), direction, basis);
  vec3 sum(0);
  for (std::size_t k = 0; k < function.values.size(); ++k) sum += basis[k] * function.values[k];
  return glm::max(sum, vec3(0));
}

/// The way to the sphere's surface: what stands inside does not shadow the light that stands for it.
scene::RayQuery to_sphere(const vec3& from, const SphlEmitter& emitter) {
  const vec3 way = emitter.position - from;
  const float distance = glm::length(way);
  return {from, way, distance > emitter.radius ? 1 - emitter.radius / distance : 0};
}

/// Marks what any part blocks.
void block(const TransportNetwork& network, const scene::TransportSource& source,
           std::span<const scene::RayQuery> segments, std::vector<std::uint8_t>& blocked) {
  blocked.assign(segments.size(), 0);
  source.occluded(0, segments, blocked);
  std::vector<scene::RayQuery> local(segments.size());
  std::vector<std::uint8_t> by_part(segments.size());
  for (int part = 1; part < source.part_count(); ++part) {
    const mat4 to_part = glm::inverse(network.poses()[static_cast<std::size_t>(part)]);
    for (std::size_t i = 0; i < segments.size(); ++i)
      local[i] = {vec3(to_part * vec4(segments[i].origin, 1)), mat3(to_part) * segments[i].direction,
                  segments[i].t_max};
    source.occluded(part, local, by_part);
    for (std::size_t i = 0; i < segments.size(); ++i) blocked[i] |= by_part[i];
  }
}

}  // namespace

bool sees(const TransportNetwork& network, const scene::TransportSource& source, const vec3& a,
          const vec3& b) {
  const scene::RayQuery segment{a, b - a, 1};
  std::vector<std::uint8_t> blocked;
  block(network, source, {&segment, 1}, blocked);
  return !blocked[0];
}

bool sees(const TransportNetwork& network, const scene::TransportSource& source, const vec3& from,
          const SphlEmitter& emitter) {
  const scene::RayQuery segment = to_sphere(from, emitter);
  std::vector<std::uint8_t> blocked;
  block(network, source, {&segment, 1}, blocked);
  return !blocked[0];
}

std::size_t add_emission(const TransportNetwork& network, const scene::TransportSource& source,
                         const SphlEmitter& emitter, std::span<vec3> samples) {
  if (emitter.leaving.empty()) return 0;
  std::vector<scene::RayQuery> segments;
  std::vector<std::size_t> which;
  const float lift = network.surfels().lift() * 0.05f;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const scene::SurfacePoint& p = network.samples()[i];
    const vec3 to_light = emitter.position - p.position;
    if (!network.sample_exists(i) || !(glm::dot(to_light, p.normal) > 0)) continue;
    const vec3 origin = p.position + lift * p.normal;
    segments.push_back(to_sphere(origin, emitter));
    which.push_back(i);
  }
  std::vector<std::uint8_t> blocked;
  block(network, source, segments, blocked);
  parallel_for(which.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      if (blocked[k]) continue;
      const scene::SurfacePoint& p = network.samples()[which[k]];
      const vec3 to_light = emitter.position - p.position;
      const float distance = glm::length(to_light);
      const vec3 wi = to_light / distance;
      const float ratio = emitter.radius / std::max(distance, emitter.radius);
      samples[which[k]] += pi * ratio * ratio * glm::dot(wi, p.normal) * evaluate(emitter.leaving, -wi);
    }
  });
  return segments.size();
}

void add_seen_emission(const vec3& probe, const SphlEmitter& emitter, sh::RadianceSh& out) {
  const vec3 to_light = emitter.position - probe;
  const float distance = glm::length(to_light);
  if (emitter.leaving.empty() || !(distance > 0)) return;
  const vec3 direction = to_light / distance;
  const float sine = std::min(emitter.radius / distance, 1.0f);
  const double edge = std::sqrt(1 - double(sine) * double(sine));
  const sh::ZonalSh disc = sh::zonal_from_function(
      out.degree(), [](double) { return 1.0; }, edge);
  std::vector<float> lobe(out.values.size());
  sh::rotate_zonal(disc, direction, lobe);
  const vec3 radiance = evaluate(emitter.leaving, -direction);
  for (std::size_t k = 0; k < lobe.size(); ++k) out.values[k] += lobe[k] * radiance;
}

}  // namespace ssphh::gi
