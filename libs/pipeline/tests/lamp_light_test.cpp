// Indirect light of a lamp that is moved: against bakes with the lamp there, and blended between places.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/lamp_lattice.h>
#include <ssphh/pipeline/lamp_light.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "number_list.h"

namespace ssphh::pipeline {
namespace {

/// A room with a lamp, baked once.
class LampLightTest : public testing::Test {
 protected:
  struct Baked {
    scene::Scene scene = scene::make_builtin("two-rooms");
    trace::SharedGeometry geometry = std::make_shared<const trace::SceneGeometry>(scene);
    trace::TransportScene source{geometry, scene};
    trace::PathTracer tracer{geometry, scene, 0};
    probes::ProbeSet set = bake_surfaces(geometry, scene, 0, bake::Quality::draft, 1);
  };
  static const Baked& baked() {
    static const Baked all;
    return all;
  }
  /// Of all points; what it is asked for does not depend on what it was asked before.
  static LampLight& lamp() {
    static LampLight light(baked().source, baked().tracer, baked().set, points());
    return light;
  }
  /// Records in the lamp's room.
  static std::vector<rays::SurfacePoint> points() {
    std::vector<rays::SurfacePoint> out;
    for (const rays::SurfacePoint& point : baked().set.surface->points)
      if (point.position.x < -0.1f) out.push_back(point);
    return out;
  }
  static std::vector<float> green(const rays::IndirectLight& light) {
    std::vector<float> out;
    for (const rays::SurfacePoint& point : points()) out.push_back(light.irradiance(point).g);
    return out;
  }
  static std::vector<float> green(std::span<const vec3> light) {
    std::vector<float> out;
    for (const vec3& e : light) out.push_back(e.g);
    return out;
  }
  /// Mean difference in shares of the mean light.
  static double mean_error(std::span<const float> light, std::span<const float> truth) {
    double error = 0, all = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) error += std::abs(light[i] - truth[i]), all += truth[i];
    return error / all;
  }
};

TEST_F(LampLightTest, IsOfABakeOfSurfacesThatKeepsRecordsOfTheQualityAndNoEdges) {
  const probes::ProbeSet& set = baked().set;
  const bake::Effort draft = bake::effort_of(bake::Quality::draft);
  EXPECT_EQ(set.generator.op, probes::LightOperator::surfel);
  EXPECT_EQ(set.generator.viz, probes::VizMethod::none);
  EXPECT_EQ(set.generator.directions, draft.directions);
  EXPECT_EQ(set.baseline->records, draft.records);
  EXPECT_EQ(probes::edge_count(set), 0u);
  EXPECT_TRUE(set.surface);
}

TEST_F(LampLightTest, AtItsOwnPlaceIsThatOfTheBake) {
  const Baked& b = baked();
  const auto lookup =
      probes::make_lookup(probes::LookupMethod::irradiance, b.set, b.tracer, lookup_params("", b.set, {}));
  const std::vector<float> truth = green(*lookup);
  ASSERT_GT(truth.size(), 100u);
  EXPECT_LT(mean_error(green(lamp().at(0, vec3(-2.4f, 2.5f, 0.5f))), truth), 0.005);
}

TEST_F(LampLightTest, ElsewhereIsThatOfABakeWithTheLampThere) {
  const Baked& b = baked();
  const vec3 place(-1.2f, 0.8f, -0.9f);
  scene::LightingState state = scene::lighting_at(b.scene, 0);
  state.lights[0].world[3] = vec4(place, 1);
  const scene::Scene moved = scene::with_lighting(b.scene, state);
  const auto geometry = std::make_shared<const trace::SceneGeometry>(moved);
  const probes::ProbeSet set = bake_surfaces(geometry, moved, 0, bake::Quality::draft, 1);
  const trace::PathTracer tracer(geometry, moved, 0);
  const auto lookup =
      probes::make_lookup(probes::LookupMethod::irradiance, set, tracer, lookup_params("", set, {}));
  const std::vector<float> truth = green(*lookup), home = green(lamp().at(0, vec3(-2.4f, 2.5f, 0.5f)));
  EXPECT_LT(mean_error(green(lamp().at(0, place)), truth), 0.03);  // other records, other noise
  EXPECT_GT(mean_error(home, truth), 0.1);
}

TEST_F(LampLightTest, HoldsNothingOfOtherLamps) {
  const Baked& b = baked();
  scene::Scene scene = b.scene;
  for (const char* group : {"", "another"}) {  // one of its own group, and one that has its own
    scene::Light other = scene.lights[0];
    if (*group) other.group = group;
    scene::Node node = scene.nodes[other.node];
    node.local.translation.x += 0.8f;
    other.node = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(node);
    scene.lights.push_back(other);
  }
  ASSERT_EQ(scene::light_groups(scene).size(), 2u);
  const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
  const trace::TransportScene source(geometry, scene);
  const trace::PathTracer tracer(geometry, scene, 0);
  const vec3 home(-2.4f, 2.5f, 0.5f);
  LampLight among(source, tracer, b.set, points());
  const std::vector<float> truth = green(lamp().at(0, home));
  EXPECT_LT(mean_error(green(among.at(0, home)), truth), 0.005);
}

TEST_F(LampLightTest, BetweenPlacesIsNearTheirBlend) {
  const Baked& b = baked();
  const LampLattice lattice = lamp_lattice(b.source, std::array{0.0f}, vec3(-2.4f, 2.5f, 0.5f));
  double worst = 0;
  for (const vec3 place : {vec3(-1.3f, 1.2f, -0.6f), vec3(-3.2f, 1.9f, 1.1f), vec3(-2, 0.6f, 0.2f)}) {
    const std::vector<float> truth = green(lamp().at(0, place));
    std::vector<float> blended(truth.size(), 0);
    for (const LampShare& share : lamp_shares(lattice, place)) {
      if (share.place < 0) continue;
      const std::vector<float> there =
          green(lamp().at(0, lattice.places[static_cast<std::size_t>(share.place)]));
      for (std::size_t i = 0; i < there.size(); ++i) blended[i] += share.weight * there[i];
    }
    worst = std::max(worst, mean_error(blended, truth));
  }
  RecordProperty("worst_mean_error", std::to_string(worst));
  EXPECT_LT(worst, 0.1);
}

TEST_F(LampLightTest, IsAsTheListHasItWithRecordsAndWithout) {
  const scene::Scene& scene = baked().scene;
  BakeSettings settings;
  settings.degree = 2, settings.op = probes::LightOperator::surfel, settings.viz = probes::VizMethod::none;
  settings.records = 48, settings.transport.records.rays = 16;
  transport::TransportParams& network = settings.transport.transport;
  network.directions = 64, network.link_rays = 16, network.surfel_size = 0.5f;
  probes::ProbeSet set = bake_scene(baked().geometry, scene, 0, {.probes = "scene"}, settings, {}).set;
  std::vector<rays::SurfacePoint> asked;
  for (std::size_t i = 0; i < 8; ++i) asked.push_back(set.surface->points[5 * i]);
  asked.push_back({{-2, 1, 0}, {0, 1, 0}, true});  // moves, so that no record is its
  test::NumberList list;
  const auto add = [&](const char* name) {
    LampLight lamp(baked().source, baked().tracer, set, asked);
    for (const vec3 place : {vec3(-2.4f, 2.5f, 0.5f), vec3(-1.2f, 0.8f, -0.9f)})
      list.add(name, place, std::string_view(":"), lamp.at(0, place));
  };
  add("records");
  set.surface.reset();
  add("probes alone");
  set.degree = 0;
  for (probes::Probe& probe : set.probes) probe.groups.clear();
  add("of degree 0");
  list.expect("libs/pipeline/tests/expected/lamp-light.txt");
}

TEST_F(LampLightTest, SaysWhatCannotBe) {
  const Baked& b = baked();
  EXPECT_THAT(test::message_of([&] { lamp().at(7, vec3(0)); }), testing::HasSubstr("no light of that index"));
  EXPECT_THAT(test::message_of([&] { lamp().at(b.scene.lights.size(), vec3(0)); }),
              testing::HasSubstr("no light of that index"));
  EXPECT_THAT(test::message_of([&] { lamp().at(0, vec3(NAN)); }), testing::HasSubstr("finite"));
}

}  // namespace
}  // namespace ssphh::pipeline
