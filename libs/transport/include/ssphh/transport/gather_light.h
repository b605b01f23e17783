#pragma once
/// Indirect light gathered at every lookup: rays from the point to the solved surfels. The best that a
/// session gives, and the stick by which cheaper lookups of its light are measured.

#include <memory>
#include <vector>

#include <ssphh/rays/radiance_source.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::transport {

class GatherLight final : public rays::IndirectLight {
 public:
  /// The light of the session's last update, by `rays` cosine rays a lookup, 4..65536; `glossy` answers for
  /// glossy light. The session must outlive this, in its pose. Throws Error for a number of rays out of
  /// range.
  GatherLight(const RelightSession& session, int rays, std::shared_ptr<const rays::IndirectLight> glossy);

  vec3 irradiance(const rays::SurfacePoint& at) const override;
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override;

 private:
  const RelightSession* session_;
  const TransportNetwork* network_;
  std::uint32_t rays_;
  std::vector<vec3> radiosity_;  ///< of each patch
  std::shared_ptr<const rays::IndirectLight> glossy_;
};

}  // namespace ssphh::transport
