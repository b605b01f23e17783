#pragma once
/// Direct light of a scene for one state of its lights and one pose of its parts.

#include <ssphh/shading/mesh_view.h>

#include "transport_data.h"

namespace ssphh::trace {

class PosedLight final : public rays::DirectLight {
 public:
  PosedLight(std::shared_ptr<const TransportData> data, std::span<const scene::LightState> lights,
             std::span<const mat4> poses, float environment_rotation);

  void irradiance(int group, std::span<const rays::SurfacePoint> points, std::span<vec3> out) const override;
  bool may_shadow(int group, const rays::SurfacePoint& point, const scene::Bounds& box) const override;
  vec3 emitted(int group, const rays::RayQuery& ray, float distance) const override;
  float flux(int group) const override;
  std::optional<rays::Photon> emit(int group, const rays::PhotonNumbers& numbers) const override;

 private:
  struct GroupEmitter {
    int index;  ///< in lights_
    shading::Emitter emitter;
  };
  /// A lit point with the place where its shadow rays start.
  struct Receiver {
    vec3 position, normal, start;
    std::uint64_t seed;
  };

  Receiver receiver(const rays::SurfacePoint& point) const;
  /// Share of a light's irradiance that arrives, past what holds it back and through glass. `draw(u)` gives a
  /// LightSample toward it, or none; `sine2` is the squared sine of the angle from its centre to its edge, 1
  /// if that is not known.
  template <class Draw>
  vec3 visible_share(const Receiver& at, std::uint64_t seed, float sine2, const Draw& draw,
                     RayTask& task) const;
  /// Of a sphere light as if nothing held it back; sets `sine2` where the point is outside of it.
  vec3 sphere_irradiance(const GroupEmitter& light, const Receiver& at, std::uint64_t seed,
                         float& sine2) const;
  vec3 irradiance_of(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, RayTask& task) const;
  vec3 sky_irradiance(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, RayTask& task) const;
  const std::vector<GroupEmitter>& emitters_of(int group) const;

  std::shared_ptr<const TransportData> data_;
  shading::LightSet lights_;
  PosedGeometry geometry_;
  std::vector<std::vector<GroupEmitter>> groups_;
};

}  // namespace ssphh::trace
