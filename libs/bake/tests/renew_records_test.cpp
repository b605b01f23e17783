#include "renew_records.h"

#include <gmock/gmock.h>

namespace ssphh::bake {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(LightScopes, HoldAllUnlessTheyNameSome) {
  LightScope scope;
  EXPECT_TRUE(scope.has_probe(7) && scope.has_group(0));
  scope.probes = {{2, 5}};
  EXPECT_TRUE(scope.has_probe(2) && scope.has_probe(5) && scope.has_group(3));
  EXPECT_FALSE(scope.has_probe(3) || scope.has_probe(6));
  scope.groups.emplace();
  EXPECT_FALSE(scope.has_group(0));
}

TEST(RecordsNearProbes, AreThoseOfTheNearestInSpace) {
  probes::ProbeSet set;
  for (const float x : {0.0f, 1.0f, 3.0f}) set.probes.emplace_back().position = {x, 0, 0};
  std::vector<rays::SurfacePoint> points;
  for (const vec3& p :
       {vec3(-5, 0, 0), vec3(0.4f, 9, 0), vec3(0.6f, 0, 9), vec3(1.9f, 0, 0), vec3(2.1f, 1, 1)})
    points.push_back({p, {0, 1, 0}});
  EXPECT_THAT(near_probes(points, set, {.probes = {{0}}, .groups = {}}), ElementsAre(1, 1, 0, 0, 0));
  EXPECT_THAT(near_probes(points, set, {.probes = {{1, 2}}, .groups = {}}), ElementsAre(0, 0, 1, 1, 1));
  EXPECT_THAT(near_probes(points, set, {}), Each(1));
}

}  // namespace
}  // namespace ssphh::bake
