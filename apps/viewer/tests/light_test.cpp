#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/transport/network.h>

#include "json_text.h"
#include "model/document.h"
#include "model/frame_times.h"
#include "model/live_light.h"
#include "model/pick.h"

namespace ssphh::viewer {
namespace {

LiveLightParams few_directions() {
  LiveLightParams params;
  params.relight.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8};
  params.relight.degree = 2;
  params.relight.records.points = 256;
  return params;
}

TEST(LiveLight, AnOpenedDoorLightsRoomB) {
  const Document document = make_document("rooms", scene::make_builtin("two-rooms"), 0);
  LiveLightParams params = few_directions();
  for (const scene::ProbePlace& place : scene::sphl_places(*document.scene, 0))
    params.places.push_back({place.name, place.position, place.radius});
  LiveLight light(document.scene, params, 0);
  const auto update = [&](float time) {
    light.update(edited_lighting(*document.scene, document.edits(), time));
  };
  update(0);
  probes::ProbeSet set = light.probes();
  ASSERT_EQ(set.probes.size(), 6u);
  ASSERT_TRUE(set.surface) << "few SPHLs see little of the walls";
  EXPECT_GT(set.surface->points.size(), 100u);
  const auto mean = [&](std::size_t probe) { return set.probes[probe].self.values[0].x; };
  const float west_shut = mean(3), lamp_room = mean(0);
  EXPECT_GT(lamp_room, 0);
  EXPECT_LT(west_shut, 1e-3f * lamp_room);
  update(1);
  light.refresh(set);
  EXPECT_GT(mean(3), 0.02f * mean(0));
  EXPECT_EQ(set, light.probes()) << "refreshing equals making anew";
}

TEST(LiveLight, FollowsLampsAndFactorsAsASessionDoes) {
  const Document document = make_document("rooms", scene::make_builtin("two-rooms"), 0);
  LiveLightParams params = few_directions();
  params.places = {{"p", {-2, 1, 0.5f}, 0.2f}, {"q", {-3, 2, 0}, 0.1f}};
  LiveLight light(document.scene, params, 0.5f);
  EXPECT_EQ(light.session().places().size(), 2u);
  EXPECT_FALSE(light.session().reflected().empty()) << "lit at once";

  scene::LightingState state = edited_lighting(*document.scene, document.edits(), 1);
  state.lights[0].intensity = 7, state.lights[0].world[3].x += 0.5f;
  state.group_scales[0] = {1, 0.5f, 2};
  light.update(state);
  transport::RelightSession session(light.source(), params.places, params.relight, 0.5f);
  session.update(session.lighting());
  session.update(state);
  EXPECT_EQ(light.session().reflected(), session.reflected());

  const probes::ProbeSet set = light.probes();
  EXPECT_EQ(set.degree, 2);
  ASSERT_EQ(set.probes.size(), 2u);
  EXPECT_EQ(set.probes[0].name, "p");
  EXPECT_EQ(set.probes[0].position, vec3(-2, 1, 0.5f));
  EXPECT_EQ(set.probes[0].radius, 0.2f);
  EXPECT_EQ(set.probes[1].self, session.reflected()[1]);
  EXPECT_EQ(set.generator.op, probes::LightOperator::surfel);
}

TEST(LiveLight, AGlanceComesFirstAndLeavesNoTrace) {
  const auto scene = std::make_shared<const scene::Scene>(scene::make_builtin("two-rooms"));
  LiveLightParams params = few_directions();
  params.spacing = 1.5f;
  params.relight.transport.surfel_size = 0.12f;
  std::shared_ptr<LiveLight> coarse;
  const auto light = find_light(scene, params, 0, {}, [&](const std::shared_ptr<LiveLight>& glance) {
    EXPECT_EQ(coarse, nullptr) << "one glance";
    coarse = glance;
  });
  ASSERT_TRUE(coarse && light);
  EXPECT_TRUE(std::ranges::equal(coarse->session().places(), light->session().places(), {},
                                 &scene::ProbePlace::position, &scene::ProbePlace::position));
  EXPECT_LT(2 * coarse->session().network().surfel_count(), 3 * 6000u) << "about as many as are asked for";
  EXPECT_LT(coarse->session().network().surfel_count(), light->session().network().surfel_count());
  EXPECT_FALSE(coarse->probes().surface);
  EXPECT_EQ(light->probes(), find_light(scene, params, 0, {})->probes());
  // It is no other light: probes are as bright, within what 32 rays a probe and large surfels err by.
  const probes::ProbeSet rough = coarse->probes(), fine = light->probes();
  double of_rough = 0, of_fine = 0;
  for (std::size_t i = 0; i < fine.probes.size(); ++i)
    of_rough += double(rough.probes[i].self.values[0].y), of_fine += double(fine.probes[i].self.values[0].y);
  EXPECT_NEAR(of_rough, of_fine, 0.1 * of_fine);
}

TEST(LiveLight, FindsPlacesWhereNoneAreGiven) {
  const auto scene = std::make_shared<const scene::Scene>(scene::make_builtin("two-rooms"));
  LiveLightParams params = few_directions();
  params.spacing = 1.5f;
  const LiveLight light(scene, params, 0);
  place::PlaceParams place = place::place_params(*scene, 0);
  place.spacing = 1.5f;
  const place::Placement wanted = place::place_probes(light.source(), place);
  ASSERT_EQ(light.session().places().size(), wanted.probes.size());
  for (std::size_t i = 0; i < wanted.probes.size(); ++i) {
    EXPECT_EQ(light.session().places()[i].name, wanted.probes[i].name);
    EXPECT_EQ(light.session().places()[i].position, wanted.probes[i].position);
    EXPECT_EQ(light.session().places()[i].radius, wanted.probes[i].radius);
  }
}

TEST(LiveLight, StandsOnTheGeometryItIsGiven) {
  const auto scene = std::make_shared<const scene::Scene>(scene::make_builtin("two-rooms"));
  LiveLightParams params = few_directions();
  params.places = {{"a", vec3(-2, 1, 0.5f), 0.1f}};
  const std::uint64_t before = trace::SceneGeometry::builds();
  const LiveLight alone(scene, params, 0);
  EXPECT_EQ(trace::SceneGeometry::builds(), before + 1);
  params.geometry = trace::geometry_of(scene);
  const LiveLight shared(scene, params, 0);
  EXPECT_EQ(trace::SceneGeometry::builds(), before + 2);
  EXPECT_EQ(shared.session().reflected()[0].values, alone.session().reflected()[0].values);
}

TEST(LiveLight, ABakeHasGroupsApartAndTellsHowItWasMade) {
  const Document document = make_document("gallery", scene::make_builtin("gallery1"), 0);
  LiveLightParams params = few_directions();
  params.places = {{"p", scene::sphl_places(*document.scene, 0)[0].position, 0.2f},
                   {"q", scene::sphl_places(*document.scene, 0)[1].position, 0.3f}};
  LiveLight light(document.scene, params, 0);
  scene::LightingState state = edited_lighting(*document.scene, document.edits(), 0.125f);
  std::vector<vec3>& scales = state.group_scales;
  ASSERT_GE(scales.size(), 2u);
  scales[1] = {0.5f, 0.25f, 2};
  light.update(state);
  const probes::ProbeSet set = light.bake(*document.scene);
  const transport::TransportParams& transport = light.session().network().params();
  probes::GeneratorInfo generator;
  generator.op = probes::LightOperator::surfel;
  generator.directions = 32, generator.surfel_size = transport.surfel_size, generator.link_rays = 8;
  generator.scene = document.scene->name, generator.scene_hash = scene::light_hash(*document.scene);
  generator.time = 0.125f;
  EXPECT_EQ(set.generator, generator);
  EXPECT_GT(set.generator.surfel_size, 0);
  EXPECT_EQ(set.degree, 2);
  const auto reflected = light.session().reflected_by_group(), emitted = light.session().emitted_by_group();
  ASSERT_EQ(set.light_groups.size(), scales.size());
  for (std::size_t g = 0; g < scales.size(); ++g) {
    EXPECT_EQ(set.light_groups[g], (probes::LightGroup{light.source().light_groups()[g], scales[g]}));
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(set.probes[i].groups[g].reflected, reflected[g][i]);
  }
  EXPECT_EQ(set.probes[1].radius, 0.3f);
  probes::ProbeSet merged = set;
  probes::merge_groups(merged);
  EXPECT_EQ(merged, set);
  EXPECT_FALSE(set.probes[0].self.empty());
}

std::vector<vec4> spheres(const std::vector<vec3>& centers, float radius) {
  std::vector<vec4> out;
  for (const vec3& center : centers) out.emplace_back(center, radius);
  return out;
}

TEST(Pick, TakesTheNearestSphereInFront) {
  const std::vector<vec3> centers{{0, 0, -9}, {0, 0.05f, -4}, {0, 0, 3}, {2, 0, -4}};
  const rays::RayQuery ray{{0, 0, 0}, {0, 0, -1}, 100};
  EXPECT_EQ(pick_sphere(ray, spheres(centers, 0.1f), 100), 1);
  EXPECT_EQ(pick_sphere(ray, spheres(centers, 0.1f), 3), -1) << "a surface is nearer";
  EXPECT_EQ(pick_sphere(ray, spheres(centers, 0.01f), 100), 0);
}

// Spheres of radius 1 straight ahead, their front at a distance of 1 and 3.
TEST(Pick, ASphereBeginsAtItsFront) {
  const std::vector<vec3> two{{0, 0, -4}, {0, 0, -2}};
  const rays::RayQuery ray{{0, 0, 0}, {0, 0, -1}, 100};
  EXPECT_EQ(pick_sphere(ray, spheres(two, 1), 100), 1);
  EXPECT_EQ(pick_sphere(ray, spheres(two, 1), 1.01f), 1);
  EXPECT_EQ(pick_sphere(ray, spheres(two, 1), 1), -1) << "a surface as near hides it";
  const std::vector<vec3> around{{0, 0, -0.5f}};
  EXPECT_EQ(pick_sphere(ray, spheres(around, 1), 100), -1) << "from within";
  const std::vector<vec3> beside{{0.6f, 0.7f, -4}};  // 0.922 from the ray
  EXPECT_EQ(pick_sphere(ray, spheres(beside, 0.93f), 100), 0);
  EXPECT_EQ(pick_sphere(ray, spheres(beside, 0.91f), 100), -1);
}

TEST(Pick, FindsTheDoorWhereItStandsAtThatTime) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const rays::RayQuery ray{{-2, 1, 0}, {1, 0, 0}, 100};
  const auto shut = pick_surface(source, 0, ray);
  ASSERT_TRUE(shut);
  EXPECT_NEAR(shut->position.x, 0.075f, 0.01f);
  EXPECT_NEAR(shut->normal.x, -1, 1e-4f);
  const auto open = pick_surface(source, 1, ray);
  ASSERT_TRUE(open);
  EXPECT_NEAR(open->position.x, 4.075f, 1e-3f) << "through the doorway to the far wall";
}

TEST(Pick, DragsAlongAnAxisAndOnAPlane) {
  const rays::RayQuery ray{{2, 3, 10}, {0, 0, -1}, 100};
  EXPECT_FLOAT_EQ(*along_axis(ray, {0, 3, 0}, {1, 0, 0}), 2);
  EXPECT_FALSE(along_axis(ray, {0, 0, 0}, {0, 0, 1}));
  EXPECT_EQ(*on_plane(ray, {0, 0, 1}, {0, 0, 1}), vec3(2, 3, 1));
  EXPECT_FALSE(on_plane(ray, {0, 0, 11}, {0, 0, 1}));
}

TEST(Pick, TheNearestPointOfAnAxisIsThatOfTwoLines) {
  // A ray that leans by 45 degrees, from (1, 2, 3) on: over the axis through (0, 2, 0) along x it passes at
  // x = 1 − 3 = −2, wherever on the axis its origin is put.
  const rays::RayQuery ray{{1, 2, 3}, glm::normalize(vec3(-1, 0, -1)), 100};
  EXPECT_NEAR(*along_axis(ray, {0, 2, 0}, {1, 0, 0}), -2, 1e-5f);
  EXPECT_NEAR(*along_axis(ray, {5, 2, 0}, {1, 0, 0}), -7, 1e-5f);
  EXPECT_NEAR(*along_axis(ray, {0, 0, 0}, {1, 0, 0}), -2, 1e-5f) << "past it, two metres above";
  const rays::RayQuery twice{{1, 2, 3}, {-2, 0, -2}, 100};
  EXPECT_NEAR(*along_axis(twice, {0, 2, 0}, {1, 0, 0}), -2, 1e-5f) << "a direction of any length";
  EXPECT_TRUE(along_axis({{0, 0, 0}, {1, 0.002f, 0}, 100}, {0, 1, 0}, {1, 0, 0}));
  EXPECT_FALSE(along_axis({{0, 0, 0}, {1, 0.0005f, 0}, 100}, {0, 1, 0}, {1, 0, 0}));
  EXPECT_NEAR(glm::distance(*on_plane(ray, {0, 0, 1}, {0, 0, 1}), vec3(-1, 2, 1)), 0, 1e-5f);
  EXPECT_FALSE(on_plane(ray, {0, 0, 1}, {0, 1, 0})) << "along the plane";
}

TEST(FrameTimes, QuantilesAreOfTheLastFramesOnly) {
  History1d times;
  EXPECT_EQ(times.quantile(0.5), 0);
  for (int i = 1; i <= 5; ++i) times.add(static_cast<float>(i));
  EXPECT_EQ(times.median(), 3);
  EXPECT_EQ(times.quantile(0.99), 5);
  EXPECT_EQ(times.at(0), 1);
  for (int i = 1; i <= History1d::length; ++i) times.add(100 + static_cast<float>(i));
  EXPECT_EQ(times.count(), History1d::length);
  EXPECT_EQ(times.at(0), 101);
  EXPECT_EQ(times.median(), 100 + History1d::length / 2);
  EXPECT_EQ(times.quantile(0), 101);
  EXPECT_EQ(times.quantile(1), 100 + History1d::length);
  EXPECT_EQ(times.last(), 100 + History1d::length);
  EXPECT_EQ(times.at(History1d::length - 1), times.last());
  EXPECT_EQ(History1d{}.last(), 0);
  EXPECT_EQ(History1d::length, 240);
}

TEST(FrameTimes, AreWrittenAsJsonAndCsv) {
  FrameTimes times;
  times.add("frame", 2), times.add("frame", 4), times.add("shadow", 1);
  const auto json = test::parse_json(times.to_json({{"renderer", "x"}}));
  EXPECT_EQ(json["renderer"], "x");
  EXPECT_EQ(json["stages"][0]["median_ms"], 2);
  EXPECT_EQ(json["stages"][0],
            json::Value({{"name", "frame"}, {"frames", 2}, {"median_ms", 2}, {"p99_ms", 4}, {"last_ms", 4}}));
  EXPECT_EQ(json["stages"][1]["frames"], 1);
  EXPECT_EQ(json["stages"].size(), 2u);
  times.clear();
  EXPECT_TRUE(times.stages().empty());
  times.add("frame", 2), times.add("frame", 4), times.add("shadow", 1);
  EXPECT_EQ(times.to_csv(), "frame,frame [ms],shadow [ms]\n0,2.0000,\n1,4.0000,1.0000\n");
}

}  // namespace
}  // namespace ssphh::viewer
