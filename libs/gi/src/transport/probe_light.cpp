#include "probe_light.h"

#include <algorithm>

#include <ssphh/core/parallel.h>

namespace ssphh::gi {

void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::vector<sh::RadianceSh>& out) {
  const std::size_t probes = network.gbuffer().positions.size();
  const std::size_t directions = network.gbuffer().directions.size(), stride = projector.stride();
  const auto radiance_of = [&](const SeenPatch& patch) {
    if (patch.surfel == no_surfel) return vec3(0);
    return unpack_albedo(patch.albedo) * (1 / pi) * vec3(irradiance[static_cast<std::size_t>(patch.surfel)]);
  };
  const std::vector<MixedHit>& mixed = network.mixed_hits();
  out.resize(probes, sh::RadianceSh(projector.degree()));
  parallel_for(probes, 8, [&](std::size_t begin, std::size_t end) {
    std::vector<float> radiance(3 * stride, 0.0f);
    auto mix = std::lower_bound(mixed.begin(), mixed.end(), begin * directions,
                                [](const MixedHit& hit, std::size_t owner) { return hit.owner < owner; });
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t q = 0; q < directions; ++q) {
        const std::size_t ray = i * directions + q;
        vec3 value = radiance_of(network.seen()[ray]);
        if (mix != mixed.end() && mix->owner == ray) {
          value += mix->share * (radiance_of(mix->other) - value);
          ++mix;
        }
        radiance[q] = value.x, radiance[stride + q] = value.y, radiance[2 * stride + q] = value.z;
      }
      projector.project(radiance, out[i]);
    }
  });
}

sh::RadianceSh project_emitted(const TransportNetwork& network, const DirectionProjector& projector,
                               std::size_t probe, int group, const scene::DirectLight& light) {
  const ProbeGBuffer& g = network.gbuffer();
  const std::size_t directions = g.directions.size(), stride = projector.stride();
  std::vector<float> radiance(3 * stride, 0.0f);
  for (std::size_t q = 0; q < directions; ++q) {
    const std::size_t ray = probe * directions + q;
    vec3 value = light.emitted(group, {g.positions[probe], g.directions[q]}, network.seen_distance()[ray]);
    if (!network.seen_emission().empty()) {
      const EmissionEntry& entry = network.palette()[network.seen_emission()[ray]];
      if (entry.group == group) value += entry.radiance;
    }
    radiance[q] = value.x, radiance[stride + q] = value.y, radiance[2 * stride + q] = value.z;
  }
  sh::RadianceSh out(projector.degree());
  projector.project(radiance, out);
  return out;
}

}  // namespace ssphh::gi
