/// Light kept at surfaces over Embree, where the answer is known.

#include <gtest/gtest.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/gather_light.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

using transport::SurfaceGather;

std::vector<rays::SurfacePoint> spread_places(const transport::TransportNetwork& network, int most) {
  return transport::spread_points(transport::surfel_points(network), most);
}

TEST(SurfaceRecords, AreAllAlikeWhereAllWallsAreAsBright) {
  // E = π ρ/(1 − ρ), whichever way a surface faces.
  constexpr float rho = 0.5f;
  GlowingBox box(rho);
  box.session.keep_records({.points = 500, .rays = 64});
  ASSERT_GT(box.session.record_light().size(), 100u);
  ASSERT_LE(box.session.record_light().size(), 500u);
  for (const probes::RecordLight& light : box.session.record_light()) {
    EXPECT_NEAR(light[3].y / (pi * rho / (1 - rho)), 1, 5e-3f);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_LT(std::abs(light[c].y), 2e-3f * light[3].y);
  }
}

/// A room whose walls differ, lit by its ceiling.
struct RecordRoom {
  RecordRoom()
      : scene(coloured_room({3, 2.5f, 2})), source(scene), session(source, places_of(scene), params()) {
    session.update();
  }
  static transport::RelightParams params() {
    transport::RelightParams params;
    params.transport = small_network();
    return params;
  }
  scene::Scene scene;
  trace::TransportScene source;
  LitSession session;
};

TEST(SurfaceRecords, HoldWhatCosineRaysMeetOfTheSurfels) {
  RecordRoom room;
  const transport::TransportNetwork& network = room.session.network();
  const std::vector<rays::SurfacePoint> points = spread_places(network, 60);
  constexpr int rays = 4096;
  const SurfaceGather gather(network, points, rays, room.session.direct_by_group());
  const std::vector<transport::Irradiance4> total = room.session.patch_irradiance();
  std::vector<probes::RecordLight> light;
  gather.light(total, light);
  // Other rays, and no more of them where it is bright
  const std::vector<std::int32_t> seen = network.gather(points, rays);
  vec3 all(0), reference(0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    vec3 sum(0);
    for (std::size_t r = p * rays; r < (p + 1) * rays; ++r) {
      if (seen[r] == transport::no_patch) continue;
      const auto s = static_cast<std::size_t>(seen[r]);
      sum += network.albedo()[s] * vec3(total[s]) / float{rays};
    }
    EXPECT_LT(glm::distance(light[p][3], sum), 0.03f * glm::length(sum)) << p;
    all += light[p][3], reference += sum;
  }
  EXPECT_LT(glm::distance(all, reference), 0.003f * glm::length(reference)) << "one is biased";
}

double relative_error(const std::vector<probes::RecordLight>& light,
                      const std::vector<probes::RecordLight>& truth) {
  double error = 0, size = 0;
  for (std::size_t p = 0; p < truth.size(); ++p) {
    const vec3 d = light[p][3] - truth[p][3];
    error += double(glm::dot(d, d)), size += double(glm::dot(truth[p][3], truth[p][3]));
  }
  return std::sqrt(error / size);
}

TEST(SurfaceRecords, GuidedRaysFindAPatchOfLightThatEvenOnesMeetByChance) {
  // All light comes from a few surfels; the guide may know it, know nothing, or be told of another place.
  RecordRoom room;
  const transport::TransportNetwork& network = room.session.network();
  const std::vector<rays::SurfacePoint> points = spread_places(network, 60);
  const auto patch = [&](std::size_t first) {
    std::vector<transport::Irradiance4> irradiance(network.patch_count(), vec4(0));
    for (std::size_t p = 0; p < irradiance.size(); ++p) {
      if (network.surfel_of(p) >= first && network.surfel_of(p) < first + 3) irradiance[p] = vec4(1);
    }
    return irradiance;
  };
  const std::vector<std::vector<transport::Irradiance4>> right = {patch(5)},
                                                         wrong = {patch(network.surfel_count() / 2)};
  const auto light = [&](int rays, std::span<const std::vector<transport::Irradiance4>> guide) {
    std::vector<probes::RecordLight> result;
    SurfaceGather(network, points, rays, guide).light(right[0], result);
    return result;
  };
  const std::vector<probes::RecordLight> truth = light(1 << 15, {});
  const double even = relative_error(light(256, {}), truth);
  EXPECT_LT(relative_error(light(256, right), truth), 0.6 * even) << "as three times as many even ones";
  // Misled, a quarter of the guided rays and one in each part are still even
  EXPECT_LT(relative_error(light(256, wrong), truth), 2.5 * even);
  EXPECT_LT(relative_error(light(1 << 14, wrong), truth), 0.5 * even) << "and it converges";
}

TEST(SurfaceRecords, GuidedRaysFindAPlainThroughWindows) {
  // Next to all of the bright plain around a house is hidden from its rooms.
  const scene::Scene scene = scene::make_builtin("house");
  const trace::TransportScene source(scene);
  LitSession session(source, {{"hall", {1, 1.5f, 1}, 0.1f}}, {});
  session.update();
  const std::vector<rays::SurfacePoint> points = spread_places(session.network(), 250);
  const std::vector<transport::Irradiance4> lit = session.patch_irradiance();
  const auto direct = session.direct_by_group();
  const auto light = [&](int rays, std::span<const std::vector<transport::Irradiance4>> guide) {
    std::vector<probes::RecordLight> result;
    SurfaceGather(session.network(), points, rays, guide).light(lit, result);
    return result;
  };
  const std::vector<probes::RecordLight> truth = light(1 << 14, direct);
  double mean = 0;
  for (const probes::RecordLight& l : truth) mean += double(l[3].y) / double(truth.size());
  const auto error = [&](const std::vector<probes::RecordLight>& found) {
    double sum = 0;
    for (std::size_t p = 0; p < truth.size(); ++p) {
      const auto e = double(truth[p][3].y);
      sum += std::abs(double(found[p][3].y) - e) / (e + 0.05 * mean);
    }
    return sum / double(truth.size());
  };
  EXPECT_LT(error(light(1024, direct)), 0.45 * error(light(1024, {})));
}

TEST(SurfaceRecords, GatheredLightIsThatOfRecordsAtTheirPlaces) {
  RecordRoom room;
  class Glossy final : public rays::IndirectLight {
   public:
    vec3 irradiance(const rays::SurfacePoint&) const override { return vec3(-1); }
    vec3 glossy(const rays::SurfacePoint&, const vec3& r, float roughness) const override {
      return r * roughness;
    }
  };
  const auto glossy = std::make_shared<const Glossy>();
  const transport::GatherLight light(room.session, 4096, glossy);
  const std::vector<rays::SurfacePoint> points = spread_places(room.session.network(), 40);
  const std::vector<transport::Irradiance4> total = room.session.patch_irradiance();
  std::vector<probes::RecordLight> records;
  SurfaceGather(room.session.network(), points, 4096).light(total, records);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const vec3 found = light.irradiance(points[p]);
    EXPECT_LT(glm::distance(found, records[p][3]), 0.03f * glm::length(records[p][3])) << p;
    EXPECT_EQ(found, light.irradiance(points[p])) << "the same bits";
  }
  EXPECT_EQ(light.glossy(points[0], {0, 1, 0}, 0.5f), vec3(0, 0.5f, 0));
  EXPECT_THROW(transport::GatherLight(room.session, 2, glossy), Error);
  EXPECT_THROW(transport::GatherLight(room.session, 64, nullptr), Error);
  const transport::RelightSession dark(room.source, scene::places_of(places_of(room.scene)),
                                       RecordRoom::params());
  EXPECT_THROW(transport::GatherLight(dark, 64, glossy), Error) << "before its first update";
}

TEST(SurfaceRecords, TurnAsTheLightAroundThemSays) {
  // The record's derivative against gathers at normals that are turned a little.
  RecordRoom room;
  const transport::TransportNetwork& network = room.session.network();
  const std::vector<rays::SurfacePoint> all = spread_places(network, 400);
  // In the middle of the walls nothing but the other walls is near
  std::vector<rays::SurfacePoint> points, turned[2];
  for (const rays::SurfacePoint& p : all) {
    const vec3 along = glm::abs(p.position) * (1.0f - glm::abs(p.normal));
    if (max_component(along) < 0.4f) points.push_back({p.position + 0.02f * p.normal, p.normal});
  }
  ASSERT_GE(points.size(), 12u);
  constexpr float angle = 0.15f;
  for (const rays::SurfacePoint& p : points) {
    const vec3 tangent = Frame::around(p.normal).x;
    for (const int k : {0, 1}) {
      const float a = k == 0 ? angle : -angle;
      turned[k].push_back({p.position, std::cos(a) * p.normal + std::sin(a) * tangent});
    }
  }
  const std::vector<transport::Irradiance4> total = room.session.patch_irradiance();
  const auto light_at = [&](const std::vector<rays::SurfacePoint>& places) {
    std::vector<probes::RecordLight> light;
    SurfaceGather(network, places, 4096).light(total, light);
    return light;
  };
  const std::vector<probes::RecordLight> light = light_at(points), plus = light_at(turned[0]),
                                         minus = light_at(turned[1]);
  double error = 0, size = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const vec3 measured = plus[p][3] - minus[p][3];
    const vec3 told = light[p] * vec4(turned[0][p].normal - turned[1][p].normal, 0);
    error += double(glm::dot(measured - told, measured - told)), size += double(glm::dot(measured, measured));
  }
  EXPECT_LT(std::sqrt(error / size), 0.1) << "of what E changes by";
}

TEST(SurfaceRecords, FollowADoorToTheBitsOfAGatherMadeThere) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const std::vector<vec3> places = positions_of(places_of(scene));
  transport::TransportNetwork network(source, places, small_network());
  const std::vector<rays::SurfacePoint> points = spread_places(network, 200);
  const float time = 0.7f * source.duration();
  SurfaceGather moved(network, points, 48);
  std::vector<transport::Irradiance4> irradiance(network.patch_count());
  for (std::size_t s = 0; s < irradiance.size(); ++s)
    irradiance[s] = vec4(1 + s % 7, 1 + s % 5, 1 + s % 3, 0);
  std::vector<probes::RecordLight> before, after, anew;
  moved.light(irradiance, before);
  network.set_time(time);
  moved.update_pose();
  moved.light(irradiance, after);
  SurfaceGather(network, points, 48).light(irradiance, anew);
  EXPECT_NE(before, after);
  EXPECT_EQ(after, anew);
  network.set_time(0);
  moved.update_pose();
  moved.light(irradiance, after);
  EXPECT_EQ(before, after);
}

TEST(SurfaceRecords, OfASessionFollowLampsAndDoors) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport = small_network();
  params.warm_start = false;
  params.records = {.points = 150, .rays = 32};
  LitSession session(source, places_of(scene), params);
  session.state.time = 0.6f * source.duration();
  session.state.lights[0].intensity *= 3;
  session.update();
  LitSession other(source, places_of(scene), params);
  other.state.time = 0.2f;
  other.update();
  other.state = session.state;
  other.update();
  EXPECT_EQ(session.record_light(), other.record_light());
  // Groups apart add up to the whole
  const probes::SurfaceRecords records = session.records_by_group();
  ASSERT_EQ(records.groups.size(), source.light_groups().size());
  for (std::size_t i = 0; i < records.light.size(); ++i) {
    EXPECT_LT(glm::distance(records.light[i][3], session.record_light()[i][3]),
              5e-3f * glm::length(records.light[i][3]) + 1e-5f);
  }
  // Those of a set for lookups are those of the session
  probes::ProbeSet set = transport::lookup_set(session);
  EXPECT_TRUE(probes::has_records(set, {}));
  session.state.lights[0].intensity = 0;
  session.update();
  transport::refresh(set, session);
  EXPECT_EQ(set.surface->light, transport::lookup_set(session).surface->light);
  EXPECT_THROW(session.keep_records({.points = -1}), Error);
  EXPECT_THROW(session.keep_records({.points = 10, .rays = 2}), Error);
  const std::vector<rays::SurfacePoint> many(70000);
  EXPECT_THROW(SurfaceGather(session.network(), many, 4), Error);
  session.keep_records({.points = 0});
  EXPECT_EQ(session.gather(), nullptr);
}

TEST(SurfaceRecords, OfABakeAreNearerToPathTracingThanProbesAre) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  bake::TransportBakeParams params;
  params.transport = small_network();
  params.transport.surfel_size = 0.15f;
  params.records.points = 3000;
  bake::TransportBakeReport report;
  probes::ProbeSet set = bake::bake_transport(source, place::init_from_scene(scene, 4), params, report);
  ASSERT_TRUE(set.surface);
  EXPECT_GT(set.surface->points.size(), 900u);
  const trace::PathTracer tracer(scene);
  const std::vector<rays::SurfacePoint> points =
      study::reachable_points(source, positions_of(places_of(scene)), 0, {200, 5});
  const auto truth =
      tracer.surface_irradiance(points, {.max_depth = 12, .passes = 1, .spp = 512, .seed = 2}, {});
  const auto error = [&] {
    const probes::IrradianceLookup lookup(set, tracer);
    std::vector<vec3> found;
    for (const rays::SurfacePoint& point : points) found.push_back(lookup.irradiance(point));
    return study::lookup_error(found, truth);
  };
  const study::LookupError records = error();
  set.surface.reset();
  const study::LookupError probes = error();
  EXPECT_NEAR(records.luminance.ratio, 1, 0.05);
  EXPECT_LT(records.luminance.mean_error, 0.1);
  EXPECT_LT(records.luminance.mean_error, 0.7 * probes.luminance.mean_error);
}

}  // namespace
}  // namespace ssphh::test
