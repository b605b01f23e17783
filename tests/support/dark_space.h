#pragma once
/// A RadianceSource without lights or surfaces: nothing arrives, nothing blocks. Tests override what they
/// ask.

#include <ssphh/rays/radiance_source.h>

namespace ssphh::test {

class DarkSpace : public rays::RadianceSource {
 public:
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest&,
                                                     const Control&) const override {
    return {};
  }
  std::vector<image::CubeMap> ghost_radiance(const rays::CubeRequest&, std::span<const rays::GhostSphere>,
                                             const GhostSink&, const Control&) const override {
    return {};
  }
  bool visible(const vec3&, const vec3&) const override { return true; }
  std::uint64_t rays_traced() const override { return 0; }

 private:
  std::vector<std::string> groups_;
};

}  // namespace ssphh::test
