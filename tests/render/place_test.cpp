// Placement in real scenes and with Embree.

#include <set>

#include <gtest/gtest.h>

#include <ssphh/place/place.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/trace/transport_scene.h>

#include "shared_scenes.h"

namespace ssphh {
namespace {

TEST(Placement, TwoRoomsWithEmbree) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  place::PlaceParams params = place::place_params(scene);
  params.spacing = 0.7f;
  params.manual.clear();
  const place::Placement placement = place::place_probes(source, params);
  int in_doorway = 0;
  for (const place::PlacedProbe& probe : placement.probes) {
    const vec3& p = probe.position;
    EXPECT_TRUE(p.y > 0 && p.y < 3 && std::abs(p.z) < 2 && std::abs(p.x) < 4.075f) << probe.name;
    if (std::abs(p.x) > 0.075f) continue;
    EXPECT_TRUE(p.y < 2.1f && std::abs(p.z) < 0.45f) << probe.name;
    ++in_doorway;
  }
  EXPECT_GE(in_doorway, 1);
  // 5 · 4 · 5 places a room and more in its corners.
  EXPECT_GT(placement.probes.size(), 300u);
}

TEST(Placement, EveryCandidateBecomesAProbeOrIsCounted) {
  for (const char* name : {"two-rooms", "cornell"}) {
    const scene::Scene scene = scene::make_builtin(name);
    const trace::TransportScene source(scene);
    for (const int count : {0, 20}) {
      place::PlaceParams params = place::place_params(scene);
      params.spacing = 1.2f;
      params.count = count;
      const place::Placement placement = place::place_probes(source, params);
      const place::PlaceCounts& c = placement.counts;
      EXPECT_EQ(c.candidates + params.manual.size(), placement.probes.size() + c.removed()) << name;
      EXPECT_TRUE(count == 0 || placement.probes.size() == 20u) << name;
      EXPECT_EQ(c.surplus > 0, count > 0) << name;
    }
  }
}

/// The built-in house with `factor` times as much ground around.
scene::Scene house_on_a_plain(float factor) {
  scene::Scene scene = scene::make_builtin("house");
  for (scene::Node& node : scene.nodes)
    if (node.name == "ground") node.local.scale = vec3(factor, 1, factor);
  return scene;
}

TEST(Placement, AHouseGetsItsProbesHoweverFarItsGroundReaches) {
  for (const float factor : {1.0f, 80.0f}) {
    const scene::Scene scene = house_on_a_plain(factor);
    const trace::TransportScene source(scene);
    const place::Placement placement = place::place_probes(source, place::place_params(scene));
    int rooms[3] = {}, corridor = 0, outside = 0, far = 0;
    for (const place::PlacedProbe& probe : placement.probes) {
      const vec3& p = probe.position;
      if (p.x > 0.2f && p.x < 12 && p.z > 0.2f && p.z < 8 && p.y < 2.7f) {
        if (p.z > 5.7f)
          ++corridor;
        else if (p.z < 5.5f)
          ++rooms[p.x < 4 ? 0 : (p.x < 8 ? 1 : 2)];
      } else {
        ++outside;
        far += glm::length(p) > 40 * factor;
      }
    }
    for (const int room : rooms) EXPECT_GE(room, 8) << "ground times " << factor;
    EXPECT_GE(corridor, 8) << "ground times " << factor;
    EXPECT_GE(outside, 20) << "ground times " << factor;
    EXPECT_GE(far, 4) << "ground times " << factor;
    EXPECT_LE(placement.probes.size(), 300u);
    const place::PlaceCounts& c = placement.counts;
    EXPECT_EQ(c.candidates, placement.probes.size() + c.removed() - c.swept);
  }
}

TEST(Placement, SomethingSmallAndFineDoesNotTakeARoomsProbes) {
  scene::Scene scene = scene::make_builtin("cornell");
  const auto spacing = [&] {
    const trace::TransportScene source(scene);
    place::PlaceParams params = place::place_params(scene);
    params.manual.clear();
    return place::place_probes(source, params).spacing;
  };
  const float before = spacing();
  scene::Mesh knot = scene::make_torus_knot(2, 3, 0.04f, 0.02f, 0.01f, 160, 14);
  knot.material = 0;
  scene.meshes.push_back(std::move(knot));
  scene.nodes.emplace_back().local.translation = vec3(0.1f, 0.2f, 0.7f);
  scene::Instance& instance = scene.instances.emplace_back();
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = static_cast<int>(scene.nodes.size()) - 1;
  EXPECT_NEAR(spacing(), before, 0.3f * before);
}

TEST(Placement, TheGalleriesHallIsFilled) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  const trace::TransportScene source(scene);
  place::PlaceParams params = place::place_params(scene);
  params.spacing = 2;
  params.manual.clear();
  std::set<int> octants;
  for (const place::PlacedProbe& probe : place::place_probes(source, params).probes) {
    const vec3& p = probe.position;
    EXPECT_LT(std::abs(p.x), 5);
    EXPECT_LT(std::abs(p.z), 4);
    EXPECT_TRUE(p.y > 0 && p.y < 4);
    octants.insert((p.x > 0 ? 1 : 0) + (p.y > 2 ? 2 : 0) + (p.z > 0 ? 4 : 0));
  }
  EXPECT_EQ(octants.size(), 8u);
}

TEST(Placement, SponzasAtticStaysEmpty) {
  SSPHH_SHARED_SCENE(file, "sponza/sponza.glb");
  const scene::Scene scene = scene_io::load_scene(file.string());
  const trace::TransportScene source(scene);
  place::PlaceParams params;
  params.interest = {{0, 3, 0}};  // somebody in the nave
  params.spacing = 3;
  const place::Placement placement = place::place_probes(source, params);
  EXPECT_GT(placement.counts.unreachable, 0u);
  EXPECT_GT(placement.probes.size(), 300u);
  bool nave = false, gallery = false;
  for (const place::PlacedProbe& probe : placement.probes) {
    const vec3& p = probe.position;
    // Over the upper gallery's ceiling at 10 m and under the roof, all around the open court.
    EXPECT_FALSE(p.y > 10.3f && p.y < 12 && std::abs(p.z) > 5) << probe.name;
    nave = nave || (p.y < 4 && std::abs(p.z) < 2);
    gallery = gallery || (p.y > 5 && p.y < 9 && std::abs(p.z) > 4);
  }
  EXPECT_TRUE(nave && gallery);
}

}  // namespace
}  // namespace ssphh
