/// Light of a session's records, and what is gathered where there are none.

#include <gtest/gtest.h>

#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/recorded_light.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

/// A gallery with few records, so that many places see none.
struct Gallery {
  explicit Gallery(int records) : session(source, places_of(scene), params(records)) {
    session.update();
    const probes::ProbeSet set = transport::lookup_set(session);
    const auto sees = [this](const vec3& a, const vec3& b) { return world.visible(a, b); };
    lookup = std::make_shared<const probes::IrradianceLookup>(
        set, probes::make_weights(scene::positions_of(session.places()), sees), probes::LookupParams{},
        std::make_shared<const probes::SurfaceInterpolation>(session.gather()->points(), sees));
  }
  static transport::RelightParams params(int records) {
    transport::RelightParams params;
    params.transport = small_network();
    params.records.points = records, params.records.rays = 64;
    return params;
  }

  scene::Scene scene = scene::make_builtin("gallery1");
  trace::TransportScene source{scene};
  rays::PosedWorld world{source, 0};
  LitSession session;
  std::shared_ptr<const probes::IrradianceLookup> lookup;
};

TEST(RecordedLight, IsGatheredWhereNoRecordIsNear) {
  const Gallery gallery(40);
  const transport::RecordedLight light(gallery.session, gallery.lookup);
  const transport::GatherLight gathered(gallery.session, 256, gallery.lookup);
  int without = 0;
  for (rays::SurfacePoint p : transport::surfel_points(gallery.session.network())) {
    const std::optional<vec3> recorded = gallery.lookup->recorded_irradiance(p);
    without += !recorded;
    ASSERT_EQ(light.irradiance(p), recorded ? *recorded : gathered.irradiance(p));
    p.moves = true;
    ASSERT_EQ(light.irradiance(p), gallery.lookup->irradiance(p)) << "of what moves probes tell";
  }
  EXPECT_GT(without, 30);
  const rays::SurfacePoint floor{{0, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(light.glossy(floor, {0, 1, 0}, 0.3f), gallery.lookup->glossy(floor, {0, 1, 0}, 0.3f));
  EXPECT_THROW(transport::RecordedLight(gallery.session, nullptr), Error);
}

TEST(RecordedLight, IsNearerToTheTruthThanThatOfProbes) {
  const Gallery gallery(40);
  const transport::RecordedLight light(gallery.session, gallery.lookup);
  const transport::GatherLight truth(gallery.session, 4096, gallery.lookup);
  vec3 off(0), off_by_probes(0);
  for (const rays::SurfacePoint& p : transport::surfel_points(gallery.session.network())) {
    if (gallery.lookup->recorded_irradiance(p)) continue;
    const vec3 e = truth.irradiance(p);
    off += glm::abs(light.irradiance(p) - e), off_by_probes += glm::abs(gallery.lookup->irradiance(p) - e);
  }
  for (int c = 0; c < 3; ++c) EXPECT_LT(off[c], 0.3f * off_by_probes[c]) << c;
}

TEST(RecordedLight, HasTheDirectLightThatRecordsHold) {
  // A disc of ground under a sky, as coloured as its light; on it a box.
  scene::Scene scene;
  scene.environment.emplace().color = vec3(1, 2, 4);
  scene.nodes.emplace_back();
  scene.materials.emplace_back().base_color = vec3(0.5f);
  scene.materials[0].specular = 0;
  scene.meshes = {scene::make_quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}),
                  scene::make_box(vec3(-0.5f, 0, -0.5f), vec3(0.5f, 1, 0.5f))};
  for (scene::Mesh& mesh : scene.meshes) mesh.material = 0;
  scene.instances = {{0, 0, -1, ""}, {1, 0, -1, ""}};
  const trace::TransportScene source(scene);
  const std::vector<scene::ProbePlace> place(1, {"", vec3(1.5f, 1, 0)});
  transport::RelightParams params = Gallery::params(64);
  params.records.baked = {0};
  LitSession session(source, place, params);
  session.update();
  const rays::SurfacePoint open{{2, 0, 2}, {0, 1, 0}};
  for (int c = 0; c < 3; ++c) {
    const float sky = pi * vec3(1, 2, 4)[c];
    EXPECT_NEAR(session.kept_direct(open)[c], sky, 0.05f * sky) << c;
  }
  // To a lookup without records all is gathered: at their places what they hold, with what the ground
  // reflects
  const auto lookup = std::make_shared<const probes::IrradianceLookup>(
      transport::lookup_set(session),
      probes::make_weights({&place[0].position, 1}, [](const vec3&, const vec3&) { return true; }));
  const transport::RecordedLight light(session, lookup);
  vec3 sum(0), of_records(0);
  const probes::ProbeSet set = transport::lookup_set(session);
  const probes::SurfaceRecords& records = *set.surface;
  for (std::size_t i = 0; i < records.points.size(); ++i) {
    sum += light.irradiance(records.points[i]);
    of_records += vec3(records.light[i] * vec4(records.points[i].normal, 1));
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / of_records[c], 1, 0.03f) << c;
  params.records.baked.clear();
  LitSession none(source, place, params);
  none.update();
  EXPECT_EQ(none.kept_direct(open), vec3(0));
}

}  // namespace
}  // namespace ssphh::test
