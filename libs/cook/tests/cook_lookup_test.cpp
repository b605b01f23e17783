/// Cooked files give what their formulas say, and at the set's scales what its lookup gives with the same
/// sight.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/probes/hier.h>
#include <ssphh/scene/probe_place.h>

#include "cooked_reference.h"
#include "cooked_room.h"
#include "expect_near.h"

namespace ssphh::test {
namespace {

using probes::ProbeSet;

struct Compared {
  double worst = 0;       ///< difference, in shares of the mean irradiance
  std::size_t apart = 0;  ///< places beyond 1e-5
  std::size_t by_points = 0;
};

Compared compare(const ProbeSet& set, const std::vector<rays::SurfacePoint>& places,
                 const scene::Scene& scene = two_rooms_with_a_wall()) {
  const TriangleSource source(scene);
  const CookedReference reference(scene, source, set, 16);
  const cook::CookScene cook_scene{scene, source};
  const OpenedFile file(cook::cook(set, &cook_scene, {16}).bytes);
  EXPECT_EQ(file.result, SSPHH_RUNTIME_OK) << ssphh_runtime_message(file.result);
  std::vector<double> differences;
  double sum = 0;
  Compared out;
  for (const rays::SurfacePoint& at : places) {
    const vec3 expected = reference.irradiance(at), found = file.irradiance(at);
    sum += static_cast<double>(expected.x + expected.y + expected.z) / 3;
    differences.push_back(static_cast<double>(glm::length(expected - found)));
    out.by_points += reference.by_points(at);
  }
  const double mean = sum / static_cast<double>(places.size());
  for (const double d : differences) {
    out.worst = std::max(out.worst, d / mean);
    out.apart += d > 1e-5 * mean;
  }
  return out;
}

TEST(CookedLookup, RecordsOfSurfacesToFiveDigits) {
  const Compared found = compare(set_of_two_rooms(OnSurfaces::records), places_on_surfaces(2000, 8));
  EXPECT_LT(found.worst, 1e-5);
  EXPECT_GT(found.by_points, 1900u) << "the records serve";
}

TEST(CookedLookup, RecordsOfAWidePlainBesideTheRooms) {
  // Two grids: one of the rooms' small cells, and one over the plain, whose records are 300 m apart
  scene::Scene scene = two_rooms_with_a_wall();
  scene.meshes.push_back(scene::make_quad({-1500, -0.5f, -1500}, {0, 0, 3000}, {3000, 0, 0}));
  scene.meshes.back().material = 0;
  scene.instances.push_back({static_cast<int>(scene.instances.size()), 0, -1, ""});
  ProbeSet set = set_of_two_rooms(OnSurfaces::records);
  std::vector<rays::SurfacePoint> places = places_on_surfaces(1000, 8);
  Pcg32 random(3);
  for (int i = 0; i < 100; ++i) {
    const vec3 place(300 * static_cast<float>(i % 10) - 1350, -0.5f, 300 * static_cast<float>(i / 10) - 1350);
    set.surface->points.push_back({place, {0, 1, 0}});
    for (auto& group : set.surface->groups) {
      probes::RecordLight light;
      for (glm::length_t c = 0; c < 4; ++c) light[c] = random.uniform3() + vec3(c == 3 ? 2 : 0);
      group.push_back(probes::pack(light, {0, 1, 0}));
    }
    places.push_back({place + 280.0f * vec3(random.uniform() - 0.5f, 0, random.uniform() - 0.5f), {0, 1, 0}});
  }
  probes::merge_groups(set);
  const TriangleSource source(scene);
  const auto lists =
      probes::prepare_surfaces(scene, 0, set.surface->points, [&](const vec3&, const vec3&) { return true; });
  EXPECT_LT(lists.grids[0].cell_size, 0.3f);
  EXPECT_GT(lists.grids[1].cell_size, 1.5f);
  const Compared found = compare(set, places, scene);
  EXPECT_LT(found.worst, 1e-5);
  EXPECT_GT(found.by_points, 1050u) << "of 1100: the records serve";
}

TEST(CookedLookup, ProbesToFiveDigits) {
  // Where a distance lies next to the one asked for, its 16 bits may decide otherwise than the ray
  for (const bool open : {false, true}) {
    const Compared found = compare(set_of_two_rooms(OnSurfaces::nothing),
                                   open ? places_in_the_open(2000, 8) : places_on_surfaces(2000, 8));
    EXPECT_LE(found.apart, 4u) << "of 2000" << (open ? " in the open" : "") << ", worst " << found.worst;
    EXPECT_EQ(found.by_points, 0u);
  }
}

TEST(CookedLookup, ProbesBelowAStillSurfaceAreHidden) {
  // Anywhere, so that probes stand on all sides of the surface; and where probes stand
  const ProbeSet set = set_of_two_rooms(OnSurfaces::nothing);
  std::vector<rays::SurfacePoint> places = places_in_the_open(1000, 12);
  for (rays::SurfacePoint& at : places) at.moves = false;
  EXPECT_LE(compare(set, places).apart, 4u);
  places.clear();
  for (const probes::Probe& probe : set.probes) {
    places.push_back({probe.position, {0, 1, 0}, false});
    places.push_back({probe.position, {0, 0, 1}, true});
  }
  EXPECT_EQ(compare(set, places).apart, 0u);
}

TEST(CookedLookup, WhatHidesProbesMatters) {
  const ProbeSet set = set_of_two_rooms(OnSurfaces::nothing);
  const OpenedFile file(cook_two_rooms(set)), all_seen(cook_two_rooms(set, 0));
  for (const std::vector<rays::SurfacePoint>& places :
       {places_on_surfaces(500, 8), places_in_the_open(500, 8)}) {
    int apart = 0;
    for (const rays::SurfacePoint& at : places)
      apart += glm::distance(file.irradiance(at), all_seen.irradiance(at)) >
               0.05f * glm::length(file.irradiance(at));
    EXPECT_GT(apart, 30) << "of 500";
  }
}

TEST(CookedLookup, AGroupThatIsOffIsWindowedByItself) {
  ProbeSet set = set_of_two_rooms(OnSurfaces::nothing);
  for (probes::Probe& probe : set.probes) probe.groups[2].reflected[0] = vec3(0.5f);  // rings
  probes::merge_groups(set);
  const OpenedFile file(cook::cook(set, nullptr).bytes);
  const vec3 off(0), one(1);
  for (std::uint32_t g = 0; g < 3; ++g)
    ssphh_runtime_set_group_scale(file.runtime, g, g == 2 ? &one.x : &off.x);
  for (probes::LightGroup& group : set.light_groups) group.scale = vec3(group.name.starts_with("night"));
  probes::merge_groups(set);
  const std::vector<vec3> positions = scene::positions_of(set.probes);
  const probes::IrradianceLookup lookup(
      set, probes::make_weights(positions, [](const vec3&, const vec3&) { return true; }));
  for (const rays::SurfacePoint& at : places_in_the_open(200, 3))
    expect_near(file.irradiance(at), lookup.irradiance(at));
}

TEST(CookedLookup, FittedPointsButForTheHighBandsAwayFromTheirNormals) {
  // On walls, whose points all have the place's normal, these bands are exact
  const Compared flat = compare(set_of_two_rooms(OnSurfaces::fitted), places_on_surfaces(2000, 8));
  EXPECT_LT(flat.worst, 1e-5);
  EXPECT_GT(flat.by_points, 1900u);
  // And with none of them everywhere
  std::vector<rays::SurfacePoint> leaning = places_on_surfaces(2000, 8);
  for (rays::SurfacePoint& at : leaning) at.normal = glm::normalize(at.normal + vec3(0.2f, 0.1f, -0.1f));
  EXPECT_LT(compare(set_of_two_rooms(OnSurfaces::fitted, 2), leaning).worst, 1e-5);
}

TEST(CookedLookup, EveryDegreeAProbeSetMayHave) {
  for (const int degree : {0, 1, 2, 3, 4, 9}) {
    const Compared found = compare(set_of_two_rooms(OnSurfaces::nothing, degree), places_in_the_open(200, 3));
    EXPECT_LE(found.apart, 1u) << "degree " << degree << ", worst " << found.worst;
  }
}

TEST(CookedLookup, OneProbeServesEverywhere) {
  ProbeSet set = set_of_two_rooms(OnSurfaces::nothing);
  set.probes.resize(1);
  EXPECT_LE(compare(set, places_in_the_open(300, 3)).apart, 1u);
}

TEST(CookedLookup, AHierarchysNeighboursAreWithin) {
  ProbeSet set = random_set(12, 8, 4, 3);
  set.fitted.reset(), set.surface.reset();
  for (const probes::HierOperator op : {probes::HierOperator::coefficient, probes::HierOperator::mean}) {
    probes::hier(set, {op, 3, 0.1f});
    const OpenedFile file(cook::cook(set, nullptr).bytes);
    const std::vector<vec3> places = scene::positions_of(set.probes);
    probes::WeightParams mls;
    mls.method = probes::WeightMethod::mls;
    const probes::IrradianceLookup lookup(set,
                                          make_weights(
                                              places, [](const vec3&, const vec3&) { return true; }, mls));
    for (rays::SurfacePoint at : places_in_the_open(100, 3)) {
      at.position = 10.0f * (at.position + vec3(2)) / 4.0f;
      const vec3 e = lookup.irradiance(at);
      // Sums of coefficients of either sign, larger than what is left of them, by weights of either sign:
      // seen to differ by 8e-5 between compilers
      EXPECT_LE(glm::distance(file.irradiance(at), e), 2e-4f * std::max(glm::length(e), 1.0f));
    }
  }
}

TEST(CookedLookup, WithoutASceneNothingHides) {
  const ProbeSet set = set_of_two_rooms(OnSurfaces::nothing);
  const OpenedFile file(cook::cook(set, nullptr).bytes);
  const std::vector<vec3> places = scene::positions_of(set.probes);
  const probes::IrradianceLookup lookup(
      set, probes::make_weights(places, [](const vec3&, const vec3&) { return true; }));
  for (const rays::SurfacePoint& at : places_in_the_open(300, 3))
    EXPECT_LE(glm::distance(file.irradiance(at), lookup.irradiance(at)),
              1e-5f * glm::length(lookup.irradiance(at)));
}

TEST(CookedLookup, GroupsAddUpAndScale) {
  for (const OnSurfaces kind : {OnSurfaces::nothing, OnSurfaces::records, OnSurfaces::fitted}) {
    const OpenedFile file(cook_two_rooms(set_of_two_rooms(kind)));
    const auto with = [&](const vec3& a, const vec3& b, const vec3& c, const rays::SurfacePoint& at) {
      const vec3 scales[] = {a, b, c};
      for (std::uint32_t g = 0; g < 3; ++g)
        EXPECT_EQ(ssphh_runtime_set_group_scale(file.runtime, g, &scales[g].x), SSPHH_RUNTIME_OK);
      return file.irradiance(at);
    };
    for (const rays::SurfacePoint& at : places_on_surfaces(50, 3)) {
      const vec3 one(1), off(0), colour(2, 0.5f, 3);
      const vec3 lamp = with(one, off, off, at), sun = with(off, one, off, at),
                 night = with(off, off, one, at);
      EXPECT_GT(lamp.x, 0) << "the light is bright enough that nothing is cut off at 0";
      const vec3 all = colour * lamp + sun + 0.25f * night;
      EXPECT_LE(glm::distance(with(colour, one, vec3(0.25f), at), all), 1e-5f * glm::length(all));
      EXPECT_EQ(with(off, off, off, at), off);
    }
  }
}

TEST(CookedLookup, RecordsAtOtherScalesAreThoseOfTheRelitSet) {
  ProbeSet set = set_of_two_rooms(OnSurfaces::records);
  const OpenedFile file(cook_two_rooms(set));
  probes::relight(set, "lamp", {0, 3, 1});
  probes::relight(set, "night \u00fc", vec3(2));
  const float lamp[] = {0, 3, 1}, night[] = {2, 2, 2};
  ssphh_runtime_set_group_scale(file.runtime, 0, lamp);
  ssphh_runtime_set_group_scale(file.runtime, 2, night);
  const scene::Scene scene = two_rooms_with_a_wall();
  const TriangleSource source(scene);
  const CookedReference reference(scene, source, set, 16);
  for (const rays::SurfacePoint& at : places_on_surfaces(500, 3)) {
    if (!reference.by_points(at)) continue;
    const vec3 e = reference.irradiance(at);
    EXPECT_LE(glm::distance(file.irradiance(at), e), 1e-5f * glm::length(e));
  }
}

TEST(CookedLookup, LightOfTheSameGeometryIsSwapped) {
  const ProbeSet day = set_of_two_rooms(OnSurfaces::records, 5, 4),
                 night = set_of_two_rooms(OnSurfaces::records, 5, 77);
  const OpenedFile a(cook_two_rooms(day)), b(cook_two_rooms(night));
  ASSERT_EQ(ssphh_runtime_swap_light(a.runtime, b.bytes().data(), b.bytes().size()), SSPHH_RUNTIME_OK);
  std::vector<rays::SurfacePoint> places = places_on_surfaces(100, 3);
  for (const rays::SurfacePoint& at : places_in_the_open(100, 3)) places.push_back(at);
  for (const rays::SurfacePoint& at : places) EXPECT_EQ(a.irradiance(at), b.irradiance(at));
}

}  // namespace
}  // namespace ssphh::test
