#include <bit>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/transport/gather_light.h>
#include <ssphh/transport/network.h>

#include "mirrors.h"
#include "network_data.h"

namespace ssphh::transport {

GatherLight::GatherLight(const RelightSession& session, int rays,
                         std::shared_ptr<const rays::IndirectLight> glossy)
    : session_(&session),
      network_(&session.network()),
      rays_(static_cast<std::uint32_t>(rays)),
      glossy_(std::move(glossy)) {
  if (rays < 4 || rays > 1 << 16) throw Error("gather rays", fmt::format("{} is outside 4..65536", rays));
  require(glossy_ != nullptr, "gathered light", "nothing answers for glossy light");
  const std::vector<vec3>& albedo = network_->albedo();
  require(session.patch_direct().size() == albedo.size() &&
              session.surfel_irradiance().size() == network_->surfel_count(),
          "gathered light", "the session has lit no surfels: update it first, with operator surfel");
  const std::vector<Irradiance4> irradiance = session.patch_irradiance();
  for (std::size_t p = 0; p < albedo.size(); ++p) radiosity_.push_back(albedo[p] * vec3(irradiance[p]));
}

vec3 GatherLight::irradiance(const rays::SurfacePoint& at) const {
  const TransportNetwork::Data& d = *network_->data_;
  // Neighbours take other rays, so that the error is grain and no pattern.
  const auto bits = [&](int c) { return std::uint64_t{std::bit_cast<std::uint32_t>(at.position[c])}; };
  const std::uint64_t salt = hash_combine(hash_combine(bits(0), bits(1)), bits(2));
  std::vector<rays::RayQuery> rays;
  for (std::uint32_t r = 0; r < rays_; ++r)
    rays.push_back(fan_ray(at, link_lift * d.surfels.size(), r, salt));
  std::vector<vec3> light(rays.size(), vec3(0));
  std::vector<rays::RayHit> hits;
  d.see(rays, hits, [&](std::size_t i, const rays::RayHit& hit, int patch) {
    if (patch != no_patch) light[i] = hit.through * radiosity_[patch];
  });
  vec3 sum(0);
  for (const vec3& l : light) sum += l;

  // What panes show.
  for (const MirrorSight& sight : follow_mirrors(d.source, rays, hits)) {
    const Resolved found = d.resolve(
        {.ray = sight.ray,
         .normal = sight.normal,
         .patch = d.find_static({sight.ray.origin + sight.ray.t_max * sight.ray.direction, sight.normal}),
         .from = sight.from});
    if (found.patch != no_patch) sum += sight.share * radiosity_[found.patch];
  }
  return sum / static_cast<float>(rays_) + session_->mirrored(at);
}

vec3 GatherLight::glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const {
  return glossy_->glossy(at, r, roughness);
}

}  // namespace ssphh::transport
