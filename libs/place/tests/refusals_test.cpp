/// What entries of the module refuse, word by word; tests/contracts asks that nothing is left half done.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/place/init.h>
#include <ssphh/place/place.h>

#include "error_message.h"
#include "unlit_source.h"

namespace ssphh::place {
namespace {

using test::message_of;

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr float endless = std::numeric_limits<float>::infinity();

/// All that stands still is at one place.
class APoint : public test::UnlitSource {
 public:
  int part_count() const override { return 1; }
  const std::string& part_name(int) const override { return name_; }
  scene::Bounds part_bounds(int) const override { return {vec3(3), vec3(3)}; }
  float duration() const override { return 0; }
  mat4 part_pose(int, float) const override { return mat4(1); }
  void intersect(int, std::span<const rays::RayQuery> rays, std::span<rays::RayHit> hits) const override {
    std::fill_n(hits.begin(), rays.size(), rays::RayHit{});
  }
  void occluded(int, std::span<const rays::RayQuery> rays, std::span<std::uint8_t> blocked) const override {
    std::fill_n(blocked.begin(), rays.size(), std::uint8_t{0});
  }
  std::uint64_t rays_traced() const override { return 0; }

 private:
  std::string name_ = "static";
};

TEST(Placement, OfASinglePointIsRefused) {
  PlaceParams params;
  params.count = 2;
  EXPECT_EQ(message_of([&] { place_probes(APoint(), params); }),
            "probe placement: the scene's surfaces are a single point");
}

TEST(Init, OfAPlacementTakesItsProbes) {
  scene::Scene scene;
  scene.name = std::string(1030, 's');
  Placement placement;
  placement.probes = {{.name = "auto 1", .position = vec3(1, 2, 3), .radius = 0.25f},
                      {.name = std::string(1030, 'n'), .position = vec3(4), .radius = 0.5f}};
  const probes::ProbeSet set = init_from_placement(scene, placement, 3, 1.5f);
  EXPECT_EQ(set.degree, 3);
  EXPECT_EQ(set.generator.time, 1.5f);
  EXPECT_EQ(set.generator.scene, std::string(1024, 's'));
  EXPECT_EQ(set.generator.scene_hash, scene::light_hash(scene));
  ASSERT_EQ(set.probes.size(), 2u);
  EXPECT_EQ(set.probes[0].name, "auto 1");
  EXPECT_EQ(set.probes[0].position, vec3(1, 2, 3));
  EXPECT_EQ(set.probes[0].radius, 0.25f);
  EXPECT_EQ(set.probes[1].name, std::string(1024, 'n'));
  for (const int degree : {-1, 11})
    EXPECT_EQ(message_of([&] { init_from_placement(scene, placement, degree); }),
              fmt::format("degree {}: the degree must be 0..10", degree));
  EXPECT_EQ(message_of([&] { init_from_placement(scene, placement, 10); }), "no error");
  const auto said = [&](const vec3& position, float radius) {
    placement.probes[0] = {.name = "p", .position = position, .radius = radius};
    return message_of([&] { init_from_placement(scene, placement, 0); });
  };
  const std::string finite = "SPHL \"p\": its position must be finite and its radius positive";
  EXPECT_EQ(said(vec3(0, endless, 0), 1), finite);
  for (const float bad : {0.0f, -1.0f, none, endless}) EXPECT_EQ(said(vec3(0), bad), finite);
}

}  // namespace
}  // namespace ssphh::place
