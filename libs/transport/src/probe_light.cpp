#include "probe_light.h"

#include <algorithm>

#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::transport {

namespace {

/// `radiance` is scratch of 3 strides, zero at their ends.
void project_one(const TransportNetwork& network, const DirectionProjector& projector,
                 std::span<const Irradiance4> irradiance, std::size_t probe, std::span<float> radiance,
                 sh::RadianceSh& out) {
  const std::size_t directions = network.gbuffer().directions.size(), stride = projector.stride();
  const std::vector<MixedHit>& mixed = network.mixed_hits();
  auto mix = std::ranges::lower_bound(mixed, probe * directions, {}, &MixedHit::owner);
  for (std::size_t q = 0; q < directions; ++q) {
    const std::size_t ray = probe * directions + q;
    vec3 value = radiance_of(network.seen()[ray], irradiance);
    if (mix != mixed.end() && mix->owner == ray) {
      value += mix->share * (radiance_of(mix->other, irradiance) - value);
      ++mix;
    }
    radiance[q] = value.x, radiance[stride + q] = value.y, radiance[2 * stride + q] = value.z;
  }
  for (const MirroredPatch& mirrored : mirrored_of(network, probe)) {
    const std::size_t q = mirrored.owner - probe * directions;
    const vec3 value = mirrored.share * radiance_of(mirrored.patch, irradiance);
    radiance[q] += value.x, radiance[stride + q] += value.y, radiance[2 * stride + q] += value.z;
  }
  projector.project(radiance, out);
}

/// Whether a group has emitters that only rays find: emissive surfaces, or the sky.
bool surfaces_emit(const rays::TransportSource& source) {
  for (int group = 0; group < static_cast<int>(source.light_groups().size()); ++group) {
    for (int part = 0; part < source.part_count(); ++part) {
      if (source.group_emits_from(group, part)) return true;
    }
  }
  return false;
}

}  // namespace

std::span<const MirroredPatch> mirrored_of(const TransportNetwork& network, std::size_t probe) {
  const std::size_t directions = network.gbuffer().directions.size();
  const std::vector<MirroredPatch>& all = network.seen_mirrored();
  const auto begin = std::ranges::lower_bound(all, probe * directions, {}, &MirroredPatch::owner);
  const auto end =
      std::ranges::lower_bound(begin, all.end(), (probe + 1) * directions, {}, &MirroredPatch::owner);
  return {begin, end};
}

vec3 radiance_of(const SeenPatch& patch, std::span<const Irradiance4> irradiance) {
  if (patch.index == no_patch) return vec3(0);
  return unpack_albedo(patch.albedo) * (1 / pi) * vec3(irradiance[patch.index]);
}

void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::vector<sh::RadianceSh>& out) {
  const std::size_t probes = network.gbuffer().positions.size();
  out.resize(probes, sh::RadianceSh(projector.degree()));
  std::vector<float> scratch;
  project_reflected(network, projector, irradiance, 0, probes, scratch, out);
}

void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::size_t begin, std::size_t end,
                       std::vector<float>& scratch, std::vector<sh::RadianceSh>& out) {
  constexpr std::size_t block = 8;
  const std::size_t floats = 3 * projector.stride();
  scratch.resize(std::max(scratch.size(), (end - begin + block - 1) / block * floats));
  parallel_for(end - begin, block, [&](std::size_t first, std::size_t last) {
    const std::span<float> radiance(scratch.data() + first / block * floats, floats);
    for (std::size_t i = begin + first; i < begin + last; ++i)
      project_one(network, projector, irradiance, i, radiance, out[i]);
  });
}

void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::size_t probe, sh::RadianceSh& out) {
  std::vector<float> radiance(3 * projector.stride(), 0.0f);
  project_one(network, projector, irradiance, probe, radiance, out);
}

std::vector<vec3> emitter_directions() {
  constexpr int count = 16384;
  std::vector<vec3> directions;
  for (int q = 0; q < count; ++q) directions.push_back(spherical_fibonacci(q, count));
  return directions;
}

std::vector<sh::RadianceSh> project_emitted(const TransportNetwork& network,
                                            const rays::TransportSource& source,
                                            const DirectionProjector& projector,
                                            std::span<const vec3> directions, const vec3& position,
                                            const rays::DirectLight& light) {
  const int group_count = static_cast<int>(source.light_groups().size());
  std::vector<sh::RadianceSh> groups(static_cast<std::size_t>(group_count),
                                     sh::RadianceSh(projector.degree()));

  // Directions in which something may emit: all of them where surfaces or the sky do.
  const bool everywhere = surfaces_emit(source);
  std::vector<std::size_t> which;
  for (std::size_t q = 0; q < directions.size(); ++q) {
    bool lit = everywhere;
    for (int group = 0; group < group_count && !lit; ++group)
      lit =
          light.emitted(group, {position, directions[q]}, std::numeric_limits<float>::infinity()) != vec3(0);
    if (lit) which.push_back(q);
  }
  if (which.empty()) return groups;

  std::vector<rays::RayQuery> rays;
  for (const std::size_t q : which) rays.push_back({position, directions[q]});
  std::vector<rays::RayHit> nearest(rays.size());
  rays::PosedWorld(source, network.poses()).intersect(rays, nearest);

  const std::size_t stride = projector.stride();
  std::vector<float> radiance(3 * stride, 0.0f);
  for (int group = 0; group < group_count; ++group) {
    bool any = false;
    for (std::size_t k = 0; k < which.size(); ++k) {
      const std::size_t q = which[k];
      vec3 value = light.emitted(group, {position, directions[q]}, nearest[k].distance);
      if (nearest[k].group == group) value += nearest[k].through * nearest[k].emission;
      radiance[q] = value.x, radiance[stride + q] = value.y, radiance[2 * stride + q] = value.z;
      any |= value != vec3(0);
    }
    if (any) projector.project(radiance, groups[group]);
  }
  return groups;
}

}  // namespace ssphh::transport
