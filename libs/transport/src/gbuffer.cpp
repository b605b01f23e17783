#include <algorithm>
#include <cmath>

#include <ssphh/core/sphere.h>
#include <ssphh/transport/gbuffer.h>

#include "mirrors.h"

namespace ssphh::transport {
namespace {

vec2 sign_not_zero(const vec2& v) {
  return {v.x < 0 ? -1.0f : 1.0f, v.y < 0 ? -1.0f : 1.0f};
}

std::uint16_t to_unorm16(float v) {
  return static_cast<std::uint16_t>(std::lround(glm::clamp(0.5f * v + 0.5f, 0.0f, 1.0f) * 65535));
}

/// Keeps 9 bits of the largest component's mantissa in all three.
vec3 quantise(const vec3& radiance) {
  const float largest = max_component(radiance);
  if (!(largest > 0)) return vec3(0);
  const float step = std::exp2(std::floor(std::log2(largest)) - 8);
  return glm::round(radiance / step) * step;
}

/// Through glass in steps of 1/16, or the palette would not suffice: each angle dims by another share.
vec3 seen_emission(const rays::RayHit& hit) {
  if (hit.through == vec3(1)) return hit.emission;
  constexpr float steps = 16;
  return hit.emission * glm::round(hit.through * steps) / steps;
}

}  // namespace

std::uint16_t EmissionPalette::find(const vec3& radiance, int group) const {
  const vec3 q = quantise(radiance);
  const auto known = index_.find({q.x, q.y, q.z, static_cast<float>(group)});
  return known == index_.end() ? std::uint16_t{0} : known->second;
}

std::uint16_t EmissionPalette::add(const vec3& radiance, int group) {
  const vec3 q = quantise(radiance);
  if (group < 0 || q == vec3(0)) return 0;
  const auto [place, inserted] = index_.try_emplace({q.x, q.y, q.z, static_cast<float>(group)});
  if (!inserted) return place->second;
  if (entries_.size() <= UINT16_MAX) {
    entries_.push_back({q, group});
    place->second = static_cast<std::uint16_t>(entries_.size() - 1);
  } else {
    const auto same_group = std::find_if(entries_.rbegin(), entries_.rend(),
                                         [&](const EmissionEntry& e) { return e.group == group; });
    const auto rank = std::distance(same_group, entries_.rend());
    place->second = static_cast<std::uint16_t>(rank > 0 ? rank - 1 : 0);
  }
  return place->second;
}

std::uint32_t pack_albedo(const vec3& albedo) {
  const vec3 v = glm::round(glm::clamp(albedo, 0.0f, 1.0f) * 1023.0f);
  return static_cast<std::uint32_t>(v.x) | static_cast<std::uint32_t>(v.y) << 10 |
         static_cast<std::uint32_t>(v.z) << 20;
}

vec3 unpack_albedo(std::uint32_t packed) {
  return vec3(static_cast<float>(packed & 1023), static_cast<float>((packed >> 10) & 1023),
              static_cast<float>((packed >> 20) & 1023)) /
         1023.0f;
}

PackedHit pack_hit(const rays::RayHit& hit, int part, EmissionPalette& palette) {
  // Octahedral map (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors,
  // 2014).
  const vec3& n = hit.normal;
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  vec2 p = sum > 0 ? vec2(n.x, n.y) / sum : vec2(0);
  if (n.z < 0) p = (1.0f - glm::abs(vec2(p.y, p.x))) * sign_not_zero(p);
  return {hit.distance,
          {to_unorm16(p.x), to_unorm16(p.y)},
          pack_albedo(hit.albedo) | (hit.back ? 1u << 30 : 0u),
          palette.add(seen_emission(hit), hit.group),
          static_cast<std::uint16_t>(part)};
}

vec3 unpack_normal(const PackedHit& hit) {
  const vec2 p = vec2(hit.normal[0], hit.normal[1]) * (2 / 65535.0f) - 1.0f;
  vec3 n(p, 1 - std::abs(p.x) - std::abs(p.y));
  if (n.z < 0) {
    const vec2 folded = (1.0f - glm::abs(vec2(n.y, n.x))) * sign_not_zero(p);
    n.x = folded.x, n.y = folded.y;
  }
  return glm::normalize(n);
}

vec3 unpack_albedo(const PackedHit& hit) {
  return unpack_albedo(hit.albedo_and_back);
}

std::uint32_t ProbeGBuffer::seen_albedo(std::size_t hit) const {
  const std::uint32_t own = hits[hit].albedo_and_back & 0x3fffffffu;
  return through.empty() ? own : pack_albedo(unpack_albedo(own) * unpack_albedo(through[hit]));
}

ProbeGBuffer trace_gbuffer(const rays::TransportSource& source, std::span<const vec3> positions,
                           int direction_count, const Control& control) {
  ProbeGBuffer buffer;
  buffer.positions.assign(positions.begin(), positions.end());
  for (int q = 0; q < direction_count; ++q)
    buffer.directions.push_back(spherical_fibonacci(q, direction_count));
  const std::size_t count = buffer.directions.size();
  buffer.hits.resize(positions.size() * count);

  // Trace in blocks of probes, so that memory stays small.
  constexpr std::size_t block = 256;
  ProgressStage progress(control, "probe G-buffers", positions.size(), "probes");
  std::vector<rays::RayQuery> rays;
  std::vector<rays::RayHit> hits;
  for (std::size_t begin = 0; begin < positions.size(); begin += block) {
    control.check();
    const std::size_t end = std::min(begin + block, positions.size());
    rays.clear();
    for (std::size_t i = begin; i < end; ++i) {
      for (const vec3& direction : buffer.directions) rays.push_back({positions[i], direction});
    }
    hits.resize(rays.size());
    source.intersect(0, rays, hits);
    for (std::size_t r = 0; r < hits.size(); ++r)
      buffer.hits[begin * count + r] = pack_hit(hits[r], 0, buffer.palette);
    if (buffer.through.empty() &&
        std::ranges::any_of(hits, [](const rays::RayHit& hit) { return hit.through != vec3(1); }))
      buffer.through.assign(buffer.hits.size(), pack_albedo(vec3(1)));
    for (std::size_t r = 0; r < hits.size() && !buffer.through.empty(); ++r)
      buffer.through[begin * count + r] = pack_albedo(hits[r].through);
    for (const MirrorSight& sight : follow_mirrors(source, rays, hits)) {
      buffer.mirrored.push_back({static_cast<std::uint32_t>(begin * count) + sight.of, sight.from, sight.ray,
                                 sight.normal, sight.albedo, sight.share});
    }
    progress.advance(end - begin);
  }
  return buffer;
}

}  // namespace ssphh::transport
