#pragma once
/// A TransportSource without light groups: the base of those that only know surfaces.

#include <ssphh/rays/transport_source.h>

namespace ssphh::test {

class UnlitSource : public rays::TransportSource {
 public:
  const std::vector<std::string>& light_groups() const override { return none_; }
  bool group_emits_from(int, int) const override { return false; }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState>, std::span<const mat4>,
                                                  const scene::EnvironmentState&) const override {
    return nullptr;
  }

 private:
  std::vector<std::string> none_;
};

}  // namespace ssphh::test
