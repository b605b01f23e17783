// Light that surfaces get of a set: the lookup, and what emitters of the groups that it leaves out send
// straight.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/surface_light.h>
#include <ssphh/scene/builtin.h>

#include "error_message.h"
#include "expect_near.h"

namespace ssphh::pipeline {
namespace {

/// The floor of a room with two point lamps, in groups of their own, that are 2 m above it.
class SurfaceLightTest : public testing::Test {
 protected:
  SurfaceLightTest() {
    for (const auto& [name, x, intensity] :
         {std::tuple("left", -0.5f, 4.0f), std::tuple("right", 0.5f, 6.0f)}) {
      scene_.nodes.emplace_back().local.translation = {x, 0, 0};
      scene::Light& light = scene_.lights.emplace_back();
      light.name = name, light.intensity = intensity, light.color = {1, 0.5f, 0.25f};
      light.node = static_cast<int>(scene_.nodes.size()) - 1;
    }
    scene_.materials[0].emission = vec3(0);
  }
  probes::ProbeSet baked(const std::vector<scene::GroupMode>& modes = {}) {
    scene_.light_modes = modes;
    geometry_ = std::make_shared<const trace::SceneGeometry>(scene_);
    BakeSettings settings;
    settings.degree = 1, settings.op = probes::LightOperator::surfel, settings.viz = probes::VizMethod::none;
    settings.records = 32, settings.transport.records.rays = 16;
    transport::TransportParams& network = settings.transport.transport;
    network.directions = 32, network.link_rays = 8, network.surfel_size = 0.25f;
    return bake_scene(geometry_, scene_, 0, {.probes = "scene"}, settings, {}).set;
  }
  struct Parts {
    vec3 held_light, direct, looked_up;
    std::vector<std::string> held;
  };
  Parts at(const probes::ProbeSet& set, const rays::SurfacePoint& point, int samples = 4) const {
    const trace::TransportScene source(geometry_, scene_);
    const trace::PathTracer tracer(geometry_, scene_, 0);
    const probes::LookupParams params;
    const SurfaceLight light(source, tracer, set, params, 0);
    const probes::IrradianceLookup lookup(set, tracer, params);
    return {light.held(point), light.direct(point, samples), lookup.irradiance(point), light.held_groups()};
  }
  /// By hand, of the lamp at (x, 0, 0) and the point on the floor.
  static vec3 sent(float x, float intensity, const vec3& point) {
    const float distance = glm::distance(vec3(x, 0, 0), point);
    return vec3(1, 0.5f, 0.25f) * intensity / (distance * distance) * (1 / distance);
  }

  scene::Scene scene_ = scene::make_builtin("box");
  trace::SharedGeometry geometry_;
  const rays::SurfacePoint point_{{0.3f, -1, 0.4f}, {0, 1, 0}};
};

TEST_F(SurfaceLightTest, IsTheLookupAndEachLampTimesItsScale) {
  probes::ProbeSet set = baked();
  const vec3 left = sent(-0.5f, 4, point_.position), right = sent(0.5f, 6, point_.position);
  Parts parts = at(set, point_);
  EXPECT_TRUE(parts.held.empty());
  EXPECT_GT(parts.looked_up.x, 0.1f);
  EXPECT_EQ(parts.held_light, parts.looked_up);
  test::expect_near(parts.direct, left + right, 1e-4f);

  probes::relight(set, "left", vec3(0.5f, 2, 0));
  probes::relight(set, "right", vec3(0));
  parts = at(set, point_);
  test::expect_near(parts.direct, vec3(0.5f, 2, 0) * left, 1e-4f);
}

TEST_F(SurfaceLightTest, LeavesOutWhatTheLookupHolds) {
  const probes::ProbeSet set = baked({{"left", scene::LightMode::baked}});
  const Parts parts = at(set, point_);
  EXPECT_THAT(parts.held, testing::ElementsAre("left"));
  EXPECT_EQ(parts.held_light, parts.looked_up);
  test::expect_near(parts.direct, sent(0.5f, 6, point_.position), 1e-4f);
}

TEST_F(SurfaceLightTest, SaysWhatCannotBe) {
  const probes::ProbeSet set = baked();
  EXPECT_EQ(test::message_of([&] { at(set, point_, 0); }), "light of surfaces: fewer than 1 sample");
  const trace::TransportScene source(geometry_, scene_);
  const trace::PathTracer tracer(geometry_, scene_, 0);
  EXPECT_EQ(test::message_of([&] { SurfaceLight(source, tracer, set, {}, NAN); }),
            "time: it must be a finite number of seconds");
}

}  // namespace
}  // namespace ssphh::pipeline
