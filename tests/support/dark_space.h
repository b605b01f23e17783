#pragma once
/// A RadianceSource without lights or surfaces: nothing arrives, nothing blocks. Tests override what they
/// ask.

#include <ssphh/scene/radiance_source.h>

namespace ssphh::test {

class DarkSpace : public scene::RadianceSource {
 public:
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::vector<scene::GroupRadiance> incident_radiance(const scene::CubeRequest&,
                                                      const Control&) const override {
    return {};
  }
  std::vector<image::CubeMap> ghost_radiance(const scene::CubeRequest&, std::span<const scene::GhostSphere>,
                                             const GhostSink&, const Control&) const override {
    return {};
  }
  bool visible(const vec3&, const vec3&) const override { return true; }
  std::uint64_t rays_traced() const override { return 0; }

 private:
  std::vector<std::string> groups_;
};

}  // namespace ssphh::test
