/// Light that a pane dims on its way between surfaces: transport against path tracing.

#include <gtest/gtest.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/sphere.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/gather_light.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

namespace ssphh {
namespace {

/// A closed room of 4 × 2 × 2 m that a pane divides, if there is one; a lamp in one half and an SPHL in
/// either. The pane mirrors nothing but as asked.
scene::Scene divided_room(std::optional<vec3> tint, float roughness = 0, float specular = 0) {
  scene::Scene s;
  const auto add = [&](scene::Mesh mesh, const scene::Material& material) {
    mesh.material = static_cast<int>(s.materials.size());
    s.materials.push_back(material);
    s.nodes.emplace_back();
    scene::Instance& instance = s.instances.emplace_back();
    instance.mesh = static_cast<int>(s.meshes.size()), instance.node = static_cast<int>(s.nodes.size()) - 1;
    s.meshes.push_back(std::move(mesh));
  };
  scene::Material wall;
  wall.base_color = vec3(0.5f), wall.specular = 0;
  add(scene::flipped(scene::make_box(vec3(-2, -1, -1), vec3(2, 1, 1))), wall);
  if (tint) {
    scene::Material pane;
    pane.base_color = *tint, pane.specular = specular, pane.transmission = 1,
    pane.specular_roughness = roughness;
    add(scene::make_quad(vec3(0, -1, -1), vec3(0, 0, 2), vec3(0, 2, 0)), pane);
  }
  const auto place = [&](const vec3& at) {
    s.nodes.emplace_back().local.translation = at;
    return static_cast<int>(s.nodes.size()) - 1;
  };
  scene::Light lamp;
  lamp.name = "lamp", lamp.intensity = 5, lamp.node = place(vec3(-1, 0.3f, 0.1f));
  s.lights.push_back(lamp);
  s.sphls = {{"lit", place(vec3(-1, -0.2f, 0))}, {"behind", place(vec3(1.1f, 0.1f, -0.1f))}};
  return s;
}

/// Of lookups that nobody asks.
class NoWeights final : public probes::LookupWeights {
 public:
  probes::ProbeWeights at(const rays::SurfacePoint&) const override { return {}; }
  std::size_t bytes() const override { return 0; }
};

/// Mean reflected radiance at a point by 1536 × `spp` paths of every bounce.
vec3 traced_mean(const scene::Scene& scene, const vec3& position, int spp) {
  rays::CubeRequest request;
  request.position = position, request.face_size = 16;
  request.path.max_depth = 40, request.path.spp = spp;
  const auto groups = trace::PathTracer(scene).incident_radiance(request, {});
  vec3 sum(0);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x)
        sum += groups[0].reflected.faces[face].rgb(x, y) * static_cast<float>(texel_solid_angle(x, y, 16));
    }
  }
  return sum / (4 * pi);
}

void expect_as_traced(const scene::Scene& scene, float share, int spp = 64) {
  const trace::TransportScene source(scene);
  bake::TransportBakeReport report;
  bake::TransportBakeParams params;
  params.transport.surfel_size = 0.2f;
  const probes::ProbeSet set = bake::bake_transport(source, place::init_from_scene(scene, 2), params, report);
  for (const probes::Probe& probe : set.probes) {
    const vec3 truth = traced_mean(scene, probe.position, spp), found = sh::mean(probe.groups[0].reflected);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / truth[c], 1, share) << probe.name << ' ' << c;
  }
}

// 3 %: what patches of 0.2 m and 128 links leave without a pane as well.
TEST(GlassTransport, BouncesThroughAGreyPaneAreDimmedAsPathsAre) {
  expect_as_traced(divided_room({}), 0.03f);
  expect_as_traced(divided_room(vec3(0.5f)), 0.03f);
}

TEST(GlassTransport, RecordsBehindAPaneAreDimmedAsPathsAre) {
  const scene::Scene scene = divided_room(vec3(0.5f));
  const trace::TransportScene source(scene);
  bake::TransportBakeReport report;
  bake::TransportBakeParams params;
  params.transport.surfel_size = 0.2f;
  params.records = {.points = 60, .rays = 1024};
  const probes::ProbeSet set = bake::bake_transport(source, place::init_from_scene(scene, 2), params, report);
  const auto truth = trace::PathTracer(scene).surface_irradiance(
      set.surface->points, {.max_depth = 40, .passes = 1, .spp = 256, .seed = 3}, {});
  vec3 found(0), expected(0);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (set.surface->points[i].position.x < 0.2f) continue;
    found += vec3(set.surface->light[i][3]), expected += truth[i].indirect;
  }
  // Undimmed, what comes through the pane alone would be twice as much
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 0.05f) << c;
}

TEST(GlassTransport, GathersThroughAPaneAreDimmedAsPathsAre) {
  // Toward the lit half, where all that a place behind the pane sees first lies beyond it.
  for (const float grey : {1.0f, 0.5f}) {
    const scene::Scene scene = divided_room(vec3(grey));
    const trace::TransportScene source(scene);
    transport::RelightParams params;
    params.transport.surfel_size = 0.2f;
    transport::RelightSession session(source, scene::sphl_places(scene, 0), params);
    session.update(session.lighting());
    const auto nothing = std::make_shared<const probes::IrradianceLookup>(transport::lookup_set(session),
                                                                          std::make_unique<NoWeights>());
    const transport::GatherLight gather(session, 4096, nothing);
    vec3 found(0), expected(0);
    std::vector<rays::SurfacePoint> points;
    for (const float y : {-0.5f, 0.0f, 0.5f}) points.push_back({vec3(0.05f, y, 0.1f), {-1, 0, 0}});
    const auto truth = trace::PathTracer(scene).surface_irradiance(
        points, {.max_depth = 40, .passes = 1, .spp = 1 << 14, .seed = 3}, {});
    for (std::size_t i = 0; i < points.size(); ++i)
      found += gather.irradiance(points[i]), expected += truth[i].indirect;
    // As of bounces; undimmed it would be twice as much
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 0.03f) << grey << ' ' << c;
  }
}

/// With a lamp that paths find by way of the pane, in colour.
scene::Scene mirroring_room(const vec3& tint) {
  scene::Scene scene = divided_room(tint, 0, 1);
  scene.lights[0].type = scene::LightType::sphere, scene.lights[0].radius = 0.2f;
  scene.lights[0].color = vec3(1, 0.6f, 0.3f);
  for (scene::Material& material : scene.materials) {
    if (!material.is_glass()) material.base_color = vec3(0.1f, 0.2f, 0.3f);
  }
  return scene;
}

TEST(GlassTransport, ProbesSeeWhatAPaneMirrors) {
  expect_as_traced(mirroring_room(vec3(1)), 0.04f);
}

TEST(GlassTransport, LinksLoseNothingToAClearPane) {
  const scene::Scene scene = divided_room(vec3(1), 0, 1);
  const trace::TransportScene source(scene);
  transport::TransportParams params;
  params.surfel_size = 0.2f;
  const std::vector<vec3> places{vec3(-1, -0.2f, 0), vec3(1.1f, 0.1f, -0.1f)};
  const transport::TransportNetwork network(source, places, params);
  double sum = 0;
  for (const transport::LinkRows::Row& row : network.links().rows) {
    float whole = 0;
    for (const transport::Link& link : row.fixed) whole += link.weight;
    EXPECT_LE(whole, 1 + 1e-5f);
    sum += static_cast<double>(whole);
  }
  // What three mirrors in a row pass on
  EXPECT_NEAR(sum / static_cast<double>(network.links().rows.size()), 1, 2e-3);
}

TEST(GlassTransport, RecordsAndGathersHoldWhatAPaneMirrors) {
  const scene::Scene scene = mirroring_room(vec3(1));
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport.surfel_size = 0.2f;
  transport::RelightSession session(source, scene::sphl_places(scene, 0), params);
  session.update(session.lighting());
  // On the lit half's floor and wall, where the pane shows the lamp and the lit walls
  std::vector<rays::SurfacePoint> points{{vec3(-0.7f, -1, 0.3f), {0, 1, 0}},
                                         {vec3(-1.2f, -1, -0.4f), {0, 1, 0}},
                                         {vec3(-2, 0.2f, 0), {1, 0, 0}}};
  session.keep_records_at(points, {.points = 3, .rays = 4096});
  const auto nothing = std::make_shared<const probes::IrradianceLookup>(transport::lookup_set(session),
                                                                        std::make_unique<NoWeights>());
  const transport::GatherLight gather(session, 4096, nothing);
  const auto truth = trace::PathTracer(scene).surface_irradiance(
      points, {.max_depth = 40, .passes = 1, .spp = 1 << 16, .seed = 3}, {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vec3 record = session.record_light()[i][3], gathered = gather.irradiance(points[i]);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(record[c] / truth[i].indirect[c], 1, 0.05f) << i << ' ' << c;
      EXPECT_NEAR(gathered[c] / truth[i].indirect[c], 1, 0.05f) << i << ' ' << c;
    }
    // Without the lamp's image it would fail by more than that
    EXPECT_GT(session.mirrored(points[i]).x, 0.08f * truth[i].indirect.x) << i;
  }
}

TEST(GlassTransport, MirroredLightFollowsALampToTheBit) {
  const scene::Scene scene = mirroring_room(vec3(1));
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport.surfel_size = 0.3f;
  params.warm_start = false;
  params.records = {.points = 200, .rays = 64};
  const auto places = scene::sphl_places(scene, 0);
  scene::LightingState moved = rays::lighting_at(source);
  moved.lights[0].world[3] = vec4(-0.6f, 0.1f, -0.3f, 1);
  moved.group_scales[0] = vec3(2, 1, 0.5f);
  transport::RelightSession session(source, places, params);
  session.update(session.lighting());
  const auto records = session.gather()->points();
  const std::vector<probes::RecordLight> before = session.record_light();
  session.update(moved);
  EXPECT_NE(session.record_light(), before);
  transport::RelightSession anew(source, places, params);
  anew.keep_records_at(records, params.records);
  anew.update(moved);
  EXPECT_EQ(session.reflected(), anew.reflected());

  // A frame's time at once or in pieces, it comes to the same.
  transport::RelightSession pieces(source, places, params);
  pieces.update(pieces.lighting());
  int calls = 1;
  while (!pieces.update(moved, {}, 1e-3).finished) ++calls;
  EXPECT_GT(calls, 8);
  EXPECT_EQ(pieces.reflected(), session.reflected());
  EXPECT_EQ(pieces.record_light(), session.record_light());
}

TEST(GlassTransport, UpdatedRecordsHoldWhatAPaneMirrorsOfALampWhereItIsNow) {
  const scene::Scene scene = mirroring_room(vec3(1));
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport.surfel_size = 0.2f;
  transport::RelightSession session(source, scene::sphl_places(scene, 0), params);
  // As above
  const std::vector<rays::SurfacePoint> points{{vec3(-0.7f, -1, 0.3f), {0, 1, 0}},
                                               {vec3(-1.2f, -1, -0.4f), {0, 1, 0}}};
  session.keep_records_at(points, {.points = 2, .rays = 4096});
  session.update(session.lighting());
  scene::LightingState moved = rays::lighting_at(source);
  moved.lights[0].world[3] = vec4(-0.6f, 0.1f, -0.3f, 1);
  session.update(moved);
  const scene::Scene lit = scene::with_lighting(scene, moved);
  const auto truth = trace::PathTracer(lit).surface_irradiance(
      points, {.max_depth = 40, .passes = 1, .spp = 1 << 16, .seed = 3}, {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(session.record_light()[i][3][c] / truth[i].indirect[c], 1, 0.05f) << i << ' ' << c;
    // Without the lamp's image it would fail by more than that
    EXPECT_GT(session.mirrored(points[i]).x, 0.08f * truth[i].indirect.x) << i;
  }
}

// A frosted pane spreads light, which transport lets go straight on: as much of it, differently divided. What
// is lost is the pane's own glow, lamp light that it throws toward the probe: a quarter here.
TEST(GlassTransport, ARoughPaneLetsAsMuchLightPass) {
  expect_as_traced(divided_room(vec3(0.8f), 0.7f), 0.3f, 8);
}

// Links know the mean of the channels only: what they carry through a pane loses its colour there. Direct
// light and what probes see keep it, so that some of it is left: of blue, dimmed to a fifth, half too much
// arrives.
TEST(GlassTransport, AColouredPaneKeepsMostOfItsColour) {
  expect_as_traced(divided_room(vec3(0.8f, 0.5f, 0.2f)), 0.6f, 8);
}

}  // namespace
}  // namespace ssphh
