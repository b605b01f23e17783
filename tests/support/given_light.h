#pragma once
/// A DirectLight that answers what the test says.

#include <functional>
#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::test {

class GivenLight final : public rays::DirectLight {
 public:
  std::function<vec3(int group, const rays::SurfacePoint&)> at = [](int, const rays::SurfacePoint&) {
    return vec3(0);
  };
  std::function<bool(int group, const rays::SurfacePoint&, const scene::Bounds&)> shadowed =
      [](int, const rays::SurfacePoint&, const scene::Bounds&) { return true; };
  std::vector<float> fluxes;  ///< per group
  std::function<std::optional<rays::Photon>(int group, const rays::PhotonNumbers&)> photon;

  void irradiance(int group, std::span<const rays::SurfacePoint> points, std::span<vec3> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(group, points[i]);
  }
  bool may_shadow(int group, const rays::SurfacePoint& point, const scene::Bounds& box) const override {
    return shadowed(group, point, box);
  }
  vec3 emitted(int, const rays::RayQuery&, float) const override { return vec3(0); }
  float flux(int group) const override { return fluxes[group]; }
  std::optional<rays::Photon> emit(int group, const rays::PhotonNumbers& numbers) const override {
    return photon(group, numbers);
  }
};

}  // namespace ssphh::test
