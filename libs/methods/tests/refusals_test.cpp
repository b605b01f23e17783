/// What methods say of scenes and parameters that they cannot do, word by word.

#include <gtest/gtest.h>

#include <ssphh/methods/method_list.h>

#include "error_message.h"
#include "open_room.h"

namespace ssphh::methods {
namespace {

class Refusals : public testing::Test {
 protected:
  std::string said(const char* name, const std::vector<std::string>& settings) const {
    const MethodEntry& entry = find_method(name);
    return ssphh::test::message_of([&] {
      entry.make({scene_, room_}, MethodParameters(name, entry.parameters, settings), {});
    });
  }
  test::OpenRoom room_;
  scene::Scene scene_ = room_.scene();
};

TEST_F(Refusals, OfProbesThatCannotBePlaced) {
  EXPECT_EQ(said("irradiance-volume", {"places=scene", "interpolation=trilinear"}),
            "light probes: interpolation=trilinear needs probes on a grid (add places=grid, or interpolate "
            "within tetrahedra)");
  EXPECT_EQ(said("irradiance-volume", {"places=grid", "spacing=0.1"}),
            "probe grid: a spacing of 0.1 m makes 48488 places, over 4096 (give a larger spacing)");
  scene_.sphls.clear();
  EXPECT_EQ(said("irradiance-volume", {"places=scene"}),
            "light probes: the scene has no SPHLs of its own (let places=auto find some)");
  EXPECT_EQ(said("ssphh", {"places=scene"}),
            "method ssphh: the scene has no SPHLs of its own (let places=auto find some)");
}

TEST_F(Refusals, OfPathsThatTheSourceCannotTrace) {
  const MethodEntry& entry = find_method("ssphh-paper");
  const auto method = entry.make({scene_, room_}, MethodParameters("ssphh-paper", entry.parameters), {});
  EXPECT_EQ(ssphh::test::message_of([&] { method->update(rays::lighting_at(room_), {}); }),
            "transport source: it cannot trace paths");
}

const std::vector<std::string> small{"places=scene", "surfel_size=1.9", "directions=16", "rays=16", "edge=9"};

TEST_F(Refusals, OfTransferThatCannotBeFound) {
  std::vector<std::string> few = small;
  few.push_back("vertices=10");
  EXPECT_EQ(
      said("prt", few),
      "transfer vectors: the scene needs more than 10 vertices (give a larger edge, or allow more vertices)");
  // A lamp's mesh in the group of the sky, which transfer vectors would take for sky as well.
  scene_.materials[0].emission = vec3(0, 0.1f, 0);
  scene_.instances[0].light_group = "near";
  EXPECT_EQ(said("prt", small), "no error");
  scene_.instances[0].light_group = "sky";
  EXPECT_EQ(
      said("prt", small),
      "method prt: the environment shares its light group \"sky\" with other lights (give it a group of "
      "its own, or use environment=probes)");
  std::vector<std::string> by_probes = small;
  by_probes.push_back("environment=probes");
  EXPECT_EQ(said("prt", by_probes), "no error");
  for (scene::Node& node : scene_.nodes) node.movable = true;
  EXPECT_EQ(
      said("prt", by_probes),
      "transfer vectors: the scene has no surface that stands still (use another method: irradiance-volume)");
}

}  // namespace
}  // namespace ssphh::methods
