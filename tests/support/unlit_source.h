#pragma once
/// A TransportSource without lights, groups or points on its parts: the base of those that only know
/// surfaces.

#include <ssphh/rays/transport_source.h>

namespace ssphh::test {

class UnlitSource : public rays::TransportSource {
 public:
  std::vector<rays::PartPoint> sample_part(int, double) const override { return {}; }
  const std::vector<std::string>& light_groups() const override { return none_; }
  std::vector<scene::LightState> lights(float) const override { return {}; }
  const std::vector<std::string>& light_names() const override { return none_; }
  int light_group_of(int) const override { return -1; }
  bool group_emits_from(int, int) const override { return false; }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState>, std::span<const mat4>,
                                                  const scene::EnvironmentState&) const override {
    return nullptr;
  }

 private:
  std::vector<std::string> none_;
};

}  // namespace ssphh::test
