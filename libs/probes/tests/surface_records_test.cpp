/// Light kept at surfaces: what is packed, merged and looked up.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/surface_spacing.h>

#include "error_message.h"
#include "fake_source.h"
#include "open_space.h"
#include "random_set.h"

namespace ssphh::probes {
namespace {

using test::message_of;
using testing::HasSubstr;

/// E(n) = level + slope (n · along), RGB; `along` must be a tangent.
RecordLight light_of(const vec3& level, const vec3& slope = vec3(0), const vec3& along = vec3(1, 0, 0)) {
  RecordLight light(0);
  for (glm::length_t c = 0; c < 3; ++c) light[c] = along[c] * slope;
  light[3] = level;
  return light;
}

TEST(SurfaceRecords, PackedLightIsWithinHalfAStepOfItsLargestNumber) {
  const vec3 normal = glm::normalize(vec3(1, -2, 3)), along = Frame::around(normal).to_world({0.6f, 0.8f, 0});
  for (const float size : {1e-20f, 0.03f, 1.0f, 4e18f}) {
    const RecordLight light = light_of(size * vec3(0.9f, 0.02f, 0.5f), size * vec3(-0.3f, 0.1f, 2), along);
    const RecordLight back = unpack(pack(light, normal), normal);
    for (const vec3& n : {normal, glm::normalize(normal + 0.5f * along), glm::normalize(normal - along)}) {
      const vec3 difference = glm::abs(back * vec4(n, 1) - light * vec4(n, 1));
      EXPECT_LT(max_component(difference), 3 * 0.5f / 32767 * 2 * size) << size;
    }
  }
  EXPECT_EQ(pack(RecordLight(0), normal), PackedRecordLight());
  EXPECT_EQ(unpack({}, normal), RecordLight(0));
}

TEST(SurfaceRecords, TheLastColumnIsTheIrradianceOfTheRecordsOwnNormal) {
  // A derivative along the normal itself has no meaning, and is not kept.
  const vec3 normal = glm::normalize(vec3(-2, 1, 0.5f));
  const RecordLight back = unpack(pack(light_of({1, 2, 3}, {4, 5, 6}, normal), normal), normal);
  EXPECT_LT(glm::distance(back * vec4(normal, 1), vec3(1, 2, 3)), 1e-3f);
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_LT(glm::length(back[c]), 1e-3f);
}

TEST(SurfaceRecords, MergedLightIsTheSumOfTheScaledGroups) {
  SurfaceRecords records;
  records.points = {{vec3(0), {0, 1, 0}}, {vec3(1), {0, 1, 0}}};
  const std::vector<vec3> scales = {{1, 2, 0}, {0.5f, 0, 3}};
  for (const float g : {1.0f, 10.0f}) {
    records.groups.push_back({pack(light_of(vec3(g)), {0, 1, 0}), pack(light_of(vec3(2 * g)), {0, 1, 0})});
  }
  merge_groups(records, scales);
  EXPECT_LT(glm::distance(records.light[0][3], vec3(6, 2, 30)), 1e-3f);
  EXPECT_LT(glm::distance(records.light[1][3], vec3(12, 4, 60)), 2e-3f);
}

TEST(SurfaceRecords, ThatAreNotWholeAreRefused) {
  const auto said = [](auto spoil) {
    SurfaceRecords records = test::random_records(3, 4, 2);
    spoil(records);
    return message_of([&] { merge_groups(records, std::vector<vec3>(2, vec3(1))); });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(said([](SurfaceRecords&) {}), "no error");
  EXPECT_THAT(said([](SurfaceRecords& r) { r.groups.pop_back(); }), HasSubstr("light group"));
  EXPECT_THAT(said([](SurfaceRecords& r) { r.groups[1].pop_back(); }), HasSubstr("not every point"));
  EXPECT_THAT(said([&](SurfaceRecords& r) { r.points[2].normal.x = nan; }), HasSubstr("surface record 2"));
  EXPECT_THAT(said([&](SurfaceRecords& r) { r.groups[0][3].scale = nan; }), HasSubstr("surface record 3"));
}

/// A floor of records a metre apart, whose light rises with x and falls as the surface turns toward x.
struct Floor {
  Floor() {
    for (int i = 0; i < 64; ++i) {
      const vec3 place(static_cast<float>(i % 8), 0, static_cast<float>(i / 8));
      points.push_back({place, {0, 1, 0}});
      light.push_back(light_of(vec3(1, 2, 3) + place.x * vec3(1, 0.5f, 0), vec3(-0.5f, 0, 0.25f)));
    }
  }
  vec3 at(const rays::SurfacePoint& point) const {
    vec3 found(-1);
    EXPECT_TRUE(SurfaceInterpolation(points, everything).irradiance(point, light, found));
    return found;
  }

  std::vector<rays::SurfacePoint> points;
  std::vector<RecordLight> light;
};

TEST(SurfaceInterpolation, GivesTheRecordsLightBetweenThem) {
  const Floor floor;
  // In the middle of four records the fit is even-handed
  EXPECT_LT(glm::distance(floor.at({{3.5f, 0, 3.5f}, {0, 1, 0}}), vec3(4.5f, 3.75f, 3)), 1e-4f);
  // Toward the floor's edge only one side is left; the ridge holds the slope back a little
  EXPECT_NEAR(floor.at({{0, 0, 3.5f}, {0, 1, 0}}).x, 1, 0.2f);
}

TEST(SurfaceInterpolation, ALoneRecordAtTheBorderOfItsReachGivesItsLight) {
  // Three spacings away a record is looked at no more; just before, its weight is as good as none.
  const std::vector<rays::SurfacePoint> points{{vec3(0), {0, 1, 0}}, {{1, 0, 0}, {0, 1, 0}}};
  const std::vector<RecordLight> light{light_of({1, 2, 3}), light_of({4, 5, 6})};
  const SurfaceInterpolation records(points, everything);
  int lit = 0;
  for (float x = -3; x < -2.6f; x += 1e-4f) {
    vec3 found(-1);
    if (!records.irradiance({{x, 0, 0}, {0, 1, 0}}, light, found)) continue;
    ++lit;
    ASSERT_LT(glm::distance(found, vec3(1, 2, 3)), 0.05f) << x;
  }
  EXPECT_GT(lit, 1000);
}

TEST(SurfaceInterpolation, AFarRecordOfAPlainDoesNotTiltTheFitOfARoom) {
  // It counts for a hundredth, but its lever is twenty times as long as those of the records around.
  Pcg32 random(5);
  std::vector<rays::SurfacePoint> points;
  std::vector<RecordLight> light;
  for (int i = 0; i < 25; ++i) {
    const vec2 at = vec2(i % 5 - 2, i / 5 - 2) + 0.5f * (random.uniform2() - 0.5f);
    points.push_back({{at.x, 0, at.y}, {0, 1, 0}});
    light.push_back(light_of(vec3(2, 3, 4) + at.x * vec3(0.3f, 0, -0.2f)));
  }
  const rays::SurfacePoint at{vec3(0), {0, 1, 0}};
  vec3 room, with_plain;
  ASSERT_TRUE(SurfaceInterpolation(points, everything).irradiance(at, light, room));
  points.push_back({{30, 0, 0}, {0, 1, 0}});
  light.push_back(light_of(vec3(200, 100, 0)));
  ASSERT_GT(surface_spacings(points).back(), 20) << "it reaches far";
  ASSERT_TRUE(SurfaceInterpolation(points, everything).irradiance(at, light, with_plain));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(with_plain[c] / room[c], 1, 0.02f) << c;
}

TEST(SurfaceInterpolation, TurnsWithTheSurface) {
  const Floor floor;
  const vec3 tilted = glm::normalize(vec3(0.5f, 1, 0));
  const vec3 flat = floor.at({{3.5f, 0, 3.5f}, {0, 1, 0}}), turned = floor.at({{3.5f, 0, 3.5f}, tilted});
  EXPECT_LT(glm::distance(turned - flat, tilted.x * vec3(-0.5f, 0, 0.25f)), 1e-3f);
}

TEST(SurfaceInterpolation, IsNeverNegative) {
  Floor floor;
  for (RecordLight& light : floor.light) light = light_of(vec3(0.1f), vec3(1, 0, -1));
  const vec3 turned = floor.at({{3.5f, 0, 3.5f}, glm::normalize(vec3(0.5f, 1, 0))});
  EXPECT_GT(turned.x, 0.5f);
  EXPECT_EQ(turned.z, 0);
}

TEST(SurfaceInterpolation, HasNothingForWhatMovesFacesAwayOrIsHidden) {
  const Floor floor;
  vec3 found(0);
  const SurfaceInterpolation open(floor.points, everything);
  const SurfaceInterpolation closed(floor.points, [](const vec3&, const vec3&) { return false; });
  // Mist: what is near is seen, and no record is.
  const SurfaceInterpolation misty(floor.points,
                                   [](const vec3& a, const vec3& b) { return glm::distance(a, b) < 0.6f; });
  EXPECT_FALSE(open.irradiance({{3.5f, 0, 3.5f}, {0, 1, 0}, true}, floor.light, found));
  EXPECT_FALSE(open.irradiance({{3.5f, 0, 3.5f}, {0, -1, 0}}, floor.light, found));
  EXPECT_FALSE(open.irradiance({{3.5f, 2, 3.5f}, {0, 1, 0}}, floor.light, found));
  EXPECT_FALSE(closed.irradiance({{3.5f, 0, 3.5f}, {0, 1, 0}}, floor.light, found));
  EXPECT_FALSE(misty.irradiance_beside({{3.5f, 0, 3.5f}, {0, 1, 0}}, floor.light, found));
  EXPECT_FALSE(closed.irradiance_beside({{3.5f, 0, 3.5f}, {0, 1, 0}, true}, floor.light, found));
  EXPECT_THROW(open.irradiance({{3.5f, 0, 3.5f}, {0, 1, 0}}, std::span(floor.light).first(3), found), Error);
  EXPECT_THROW(SurfaceInterpolation(floor.points, nullptr), Error);
}

TEST(SurfaceInterpolation, WhereNothingSeesAPlaceThatIsCoveredThoseBesideItTell) {
  // The foot of a pot, a hair above the table: a place raised from it lies in the table's top.
  const Floor floor;
  const rays::SurfacePoint foot{{3.5f, 0, 3.5f}, {0, 1, 0}};
  const SurfaceInterpolation known(floor.points, [](const vec3&, const vec3&) { return false; });
  SurfaceShares shares;
  EXPECT_TRUE(known.at(foot, shares).empty());
  vec3 found(0);
  ASSERT_TRUE(known.irradiance_beside(foot, floor.light, found));
  EXPECT_LT(glm::distance(found, floor.at(foot)), 1e-3f);
}

TEST(SurfaceInterpolation, NoRecordOfAPlainLooksOverAPotsRim) {
  // A pot, hollow, 0.2 m wide and high, on a table with records around it; others stand 50 m apart.
  const auto in_pot = [](const vec3& p) { return p.x * p.x + p.z * p.z < 0.01f && p.y >= 0 && p.y < 0.2f; };
  const auto sees = [&](const vec3& a, const vec3& b) {
    for (int i = 1; i <= 200; ++i) {
      if (in_pot(glm::mix(a, b, static_cast<float>(i) / 200)) != in_pot(a)) return false;
    }
    return true;
  };
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < 9; ++i) {
    if (i == 4) continue;
    const vec3 toward(static_cast<float>(i % 3 - 1), 0, static_cast<float>(i / 3 - 1));
    points.push_back({0.3f * toward, {0, 1, 0}});
    points.push_back({50.0f * toward, {0, 1, 0}});
  }
  const SurfaceInterpolation known(points, sees), without_pot(points, everything);
  SurfaceShares shares;
  const rays::SurfacePoint within{{0, 1e-4f, 0}, {0, 1, 0}}, outside{{0.2f, 1e-4f, 0}, {0, 1, 0}};
  EXPECT_TRUE(std::ranges::any_of(without_pot.at(within, shares),
                                  [&](const SurfaceShare& s) { return known.spacing(s.point) > 10; }));
  EXPECT_TRUE(known.at(within, shares).empty());
  EXPECT_FALSE(known.at(outside, shares).empty());
}

/// A probe of light 1 over a floor of records.
struct LitFloor {
  LitFloor() {
    set = test::random_set(1, 3, 2, 1);
    for (Probe& probe : set.probes) {
      probe.position = {3.5f, 1, 3.5f};
      probe.groups[0].reflected = sh::RadianceSh(2);
      probe.groups[0].reflected[0] = vec3(1);
    }
    SurfaceRecords& records = set.surface.emplace();
    records.points = floor.points;
    records.groups.emplace_back();
    for (const RecordLight& light : floor.light) records.groups[0].push_back(pack(light, {0, 1, 0}));
    set.light_groups[0].scale = vec3(1);
    merge_groups(set);
  }
  Floor floor;
  ProbeSet set;
  test::FakeSource source;
};

TEST(SurfaceRecords, LightWhatStandsStillAndProbesLightTheRest) {
  const LitFloor lit;
  const IrradianceLookup lookup(lit.set, lit.source);
  EXPECT_LT(glm::distance(lookup.irradiance({{3.5f, 0, 3.5f}, {0, 1, 0}}), vec3(4.5f, 3.75f, 3)), 1e-3f);
  const float probes = pi * 0.28209479f;
  EXPECT_NEAR(lookup.irradiance({{3.5f, 0, 3.5f}, {0, 1, 0}, true}).y, probes, 1e-4f);
  EXPECT_NEAR(lookup.irradiance({{3.5f, 2, 3.5f}, {0, -1, 0}}).y, probes, 1e-4f);
}

TEST(SurfaceRecords, FollowTheScaleOfTheirGroup) {
  LitFloor lit;
  relight(lit.set, lit.set.light_groups[0].name, {2, 0, 1});
  const IrradianceLookup lookup(lit.set, lit.source);
  EXPECT_LT(glm::distance(lookup.irradiance({{3.5f, 0, 3.5f}, {0, 1, 0}}), vec3(9, 0, 3)), 1e-3f);
}

TEST(SurfaceRecords, AreChosenWhereTheyHoldTheLightAskedFor) {
  LitFloor lit;
  const LookupParams any;
  EXPECT_TRUE(has_records(lit.set, any));
  EXPECT_EQ(chosen_weights(lit.set, any), WeightMethod::surface);
  LookupParams all = any, mls = any;
  all.light = ProbeLight::all, mls.weights.method = WeightMethod::mls;
  EXPECT_FALSE(has_records(lit.set, all)) << "records hold no emitters";
  EXPECT_EQ(chosen_weights(lit.set, all), WeightMethod::mls);
  EXPECT_EQ(chosen_weights(lit.set, mls), WeightMethod::mls);

  lit.set.fitted = test::random_fitted(7, 3, 3);
  EXPECT_EQ(chosen_weights(lit.set, any), WeightMethod::surface);
  lit.set.surface->points.clear();
  EXPECT_FALSE(has_records(lit.set, any));
  EXPECT_EQ(chosen_weights(lit.set, any), WeightMethod::fitted);

  ProbeSet hierarchical = LitFloor().set;
  hier(hierarchical, {});
  EXPECT_FALSE(has_records(hierarchical, any)) << "HIER's light is not in them";
  LookupParams own = any;
  own.layer = ProbeLayer::self;
  EXPECT_TRUE(has_records(hierarchical, own));
}

TEST(SurfaceRecords, AskedForWhereThereAreNoneAreAnError) {
  LitFloor lit;
  LookupParams params;
  params.weights.method = WeightMethod::surface;
  EXPECT_EQ(message_of([&] { IrradianceLookup(lit.set, lit.source, params); }), "no error");
  lit.set.surface.reset();
  EXPECT_THAT(message_of([&] { IrradianceLookup(lit.set, lit.source, params); }),
              HasSubstr("no surface records"));
}

}  // namespace
}  // namespace ssphh::probes
