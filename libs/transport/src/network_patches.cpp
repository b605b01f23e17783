/// The patches of surfels: where their direct light is found, and their albedo.

#include <algorithm>

#include <ssphh/transport/solve.h>

#include "network_data.h"

namespace ssphh::transport {
void TransportNetwork::Data::choose_samples() {
  const std::size_t first = local_samples.size() / sample_count();
  std::vector<std::vector<ClusterPoint>> chosen(surfels.count() - first);
  parallel_for(chosen.size(), 16, [&](std::size_t i) {
    chosen[i] = surfels.spread_samples(static_cast<int>(first + i), params.samples);
  });
  for (const std::vector<ClusterPoint>& of_surfel : chosen) {
    for (std::size_t i = 0; i < sample_count(); ++i) {
      const bool exists = i < of_surfel.size();
      local_samples.push_back(of_surfel[exists ? i : 0].point);
      albedo.push_back(of_surfel[exists ? i : 0].albedo);
      sample_exists.push_back(exists);
    }
  }
}

void TransportNetwork::Data::find_patch_albedo() {
  parallel_for(surfels.count(), 64, [&](std::size_t s) {
    const std::size_t first = s * sample_count();
    std::vector<float> count(sample_count(), 1);
    for (const ClusterPoint& member : surfels.members(static_cast<int>(s))) {
      const auto patch = static_cast<std::size_t>(patch_at(static_cast<int>(s), member.point.position));
      albedo[patch] += member.albedo;
      ++count[patch - first];
    }
    for (std::size_t i = 0; i < sample_count(); ++i)
      albedo[first + i] = glm::min(albedo[first + i] / count[i], vec3(most_albedo));
  });
}

void TransportNetwork::Data::find_seen_patches() {
  const ProbeGBuffer& g = gbuffer;
  const auto patch_of = [&](const rays::RayQuery& ray, float distance, std::int32_t surfel) {
    return surfel == no_surfel ? no_patch : patch_at(surfel, ray.origin + distance * ray.direction);
  };
  parallel_for(g.hits.size(), 1024, [&](std::size_t i) {
    const rays::RayQuery ray{g.positions[i / g.directions.size()], g.directions[i % g.directions.size()]};
    seen[i].index = patch_of(ray, g.hits[i].distance, seen[i].index);
  });
  for (std::size_t k = 0; k < g.mirrored.size(); ++k) {
    std::int32_t& index = seen_mirrored[k].patch.index;
    index = patch_of(g.mirrored[k].ray, g.mirrored[k].ray.t_max, index);
  }
}

}  // namespace ssphh::transport
