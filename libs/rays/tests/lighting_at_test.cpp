#include <gtest/gtest.h>

#include "unlit_source.h"

namespace ssphh::rays {
namespace {

/// One lamp, whose intensity is the time, and three groups.
class Lit final : public test::UnlitSource {
 public:
  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::vector<scene::LightState> lights(float time) const override { return {{mat4(1), vec3(1), time}}; }
  int part_count() const override { return 1; }
  const std::string& part_name(int) const override { return groups_[0]; }
  scene::Bounds part_bounds(int) const override { return {}; }
  float duration() const override { return 0; }
  mat4 part_pose(int, float) const override { return mat4(1); }
  void intersect(int, std::span<const RayQuery>, std::span<RayHit>) const override {}
  void occluded(int, std::span<const RayQuery>, std::span<std::uint8_t>) const override {}
  std::uint64_t rays_traced() const override { return 0; }

 private:
  std::vector<std::string> groups_ = {"a", "b", "c"};
};

TEST(LightingAt, IsTheSourcesOwnAtItsTimeWithEveryGroupAtFullStrength) {
  const scene::LightingState wanted{2.5f, {{mat4(1), vec3(1), 2.5f}}, {vec3(1), vec3(1), vec3(1)}, 0, {}};
  EXPECT_EQ(lighting_at(Lit(), 2.5f), wanted);
  EXPECT_EQ(lighting_at(Lit()).time, 0);
}

}  // namespace
}  // namespace ssphh::rays
