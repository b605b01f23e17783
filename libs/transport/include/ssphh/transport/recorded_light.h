#pragma once
/// Light of a session's surface records, and gathered by rays where none is near.

#include <memory>
#include <mutex>
#include <optional>

#include <ssphh/probes/lookup.h>
#include <ssphh/transport/gather_light.h>

namespace ssphh::transport {

/// Where no record lies near in sight, in slits and between leaves, probes would be a guess: what stands
/// still is lit there by rays to the surfels, with the direct light that records hold. `lookup` has the
/// session's records, of its last update, and lights what moves.
class RecordedLight final : public rays::IndirectLight {
 public:
  /// The session must outlive this, in its pose.
  RecordedLight(const RelightSession& session, std::shared_ptr<const probes::IrradianceLookup> lookup);

  vec3 irradiance(const rays::SurfacePoint& at) const override;
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override;
  std::vector<std::string> direct_groups() const override;
  std::vector<std::string> mirrored_groups() const override;

 private:
  const RelightSession* session_;
  std::shared_ptr<const probes::IrradianceLookup> lookup_;
  mutable std::once_flag once_;
  mutable std::optional<GatherLight> gathered_;  ///< made when first asked for: few points need it
};

}  // namespace ssphh::transport
