#include "probe_light.h"

#include <ssphh/core/parallel.h>

namespace ssphh::gi {

void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::vector<sh::RadianceSh>& out) {
  const std::size_t probes = network.gbuffer().positions.size();
  const std::size_t directions = network.gbuffer().directions.size(), stride = projector.stride();
  out.resize(probes, sh::RadianceSh(projector.degree()));
  parallel_for(probes, 8, [&](std::size_t begin, std::size_t end) {
    std::vector<float> radiance(3 * stride, 0.0f);
    for (std::size_t i = begin; i < end; ++i) {
      const SeenPatch* seen = network.seen().data() + i * directions;
      for (std::size_t q = 0; q < directions; ++q) {
        vec3 value(0);
        if (seen[q].surfel != no_surfel) {
          value = unpack_albedo(seen[q].albedo) * (1 / pi) *
                  vec3(irradiance[static_cast<std::size_t>(seen[q].surfel)]);
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
