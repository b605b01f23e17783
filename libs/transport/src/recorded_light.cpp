#include <ssphh/core/require.h>
#include <ssphh/transport/recorded_light.h>

namespace ssphh::transport {

RecordedLight::RecordedLight(const RelightSession& session,
                             std::shared_ptr<const probes::IrradianceLookup> lookup)
    : session_(&session), lookup_(std::move(lookup)) {
  require(lookup_ != nullptr, "light of records", "there is no lookup");
}

vec3 RecordedLight::irradiance(const rays::SurfacePoint& at) const {
  constexpr int rays = 256;
  if (at.moves) return lookup_->irradiance(at);
  if (const std::optional<vec3> found = lookup_->recorded_irradiance(at)) return *found;
  std::call_once(once_, [&] { gathered_.emplace(*session_, rays, lookup_); });
  return gathered_->irradiance(at) + session_->kept_direct(at);
}

vec3 RecordedLight::glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const {
  return lookup_->glossy(at, r, roughness);
}

std::vector<std::string> RecordedLight::direct_groups() const {
  return lookup_->direct_groups();
}

std::vector<std::string> RecordedLight::mirrored_groups() const {
  return lookup_->mirrored_groups();
}

}  // namespace ssphh::transport
