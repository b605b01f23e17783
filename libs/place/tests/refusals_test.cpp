/// What entries of the module refuse, word by word; tests/contracts asks that nothing is left half done.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/place/init.h>

#include "error_message.h"

namespace ssphh::place {
namespace {

using test::message_of;

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr float endless = std::numeric_limits<float>::infinity();

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
