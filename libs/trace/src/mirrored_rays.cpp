/// Rays that sheets of glass mirror.

#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>

#include "for_rays.h"
#include "glass_passage.h"
#include "posed_light.h"

namespace ssphh::trace {
namespace {

std::uint64_t bits_of(const rays::RayQuery& ray) {
  return hash_combine(position_seed(ray.origin), position_seed(ray.direction));
}

float mean_of(const vec3& v) {
  return (v.x + v.y + v.z) / 3;
}

/// Of a ray that meets glass and ends at `distance`; a share of 0 where nothing is mirrored.
rays::MirroredRay mirrored_before(const ShadedGeometry& geometry, int part, const rays::RayQuery& ray,
                                  float distance, RayTask& task) {
  const float length = glm::length(ray.direction);
  const vec3 wo = -ray.direction / length;
  const std::uint64_t seed = bits_of(ray);
  Ray way{ray.origin, ray.direction, distance};
  rays::MirroredRay chosen;
  vec3 left(1);
  float entered = 0, all = 0;
  Hit hit;
  for (std::uint32_t met = 0; max_component(left) > 0; ++met) {
    ++task.rays;
    if (!geometry.intersect(part, way, {0, PassedGlass::none}, hit)) break;
    vec3 ray_origin;
    const shading::Surface surface = geometry.surface(hit, wo, ray_origin);
    const shading::GlassParams& glass = surface.glass;
    if (!passes(glass, 0)) break;
    if (glass.sheet) {
      SampleSequence random(seed, met);
      const vec2 u = random.next2();
      const Frame frame = Frame::around(surface.normal);
      const auto sample = shading::GlassFrom(glass, frame.to_local(wo)).sample_mirrored(u);
      const vec3 wi = sample ? frame.to_world(sample->wi) : vec3(0);
      if (sample && glm::dot(wi, surface.geometric_normal) > 0) {
        const vec3 share = left * glass.share * sample->weight;
        all += mean_of(share);
        if (random.next() * all < mean_of(share))
          chosen = {0, {ray_origin, wi}, share / std::max(mean_of(share), 1e-30f)};
      }
    } else {
      if (glass.inside) left *= attenuated(glass.absorption, (hit.distance - entered) * length);
      entered = hit.distance;
    }
    left *= glass.share * shading::straight_transmittance(glass, glm::dot(surface.normal, wo));
    way.t_min = beyond(way, hit.distance, surface, ray_origin);
  }
  chosen.share *= all;
  return chosen;
}

}  // namespace

std::vector<rays::MirroredRay> TransportScene::mirrored(int part, std::span<const rays::RayQuery> rays,
                                                        std::span<const rays::RayHit> hits) const {
  require(rays.size() == hits.size(), "rays", "there is not one hit for each");
  data_->part(part);  // throws where there is none
  std::vector<rays::MirroredRay> found;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].through != vec3(1)) found.push_back({static_cast<std::uint32_t>(i), {}, vec3(0)});
  }
  for_rays(found.size(), data_->rays, [&](std::size_t begin, std::size_t end, RayTask& task) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = found[k].of;
      found[k] =
          mirrored_before(data_->geometry, part, rays[i], std::min(rays[i].t_max, hits[i].distance), task);
      found[k].of = i;
    }
  });
  std::erase_if(found, [](const rays::MirroredRay& ray) { return !(max_component(ray.share) > 0); });
  return found;
}

}  // namespace ssphh::trace
