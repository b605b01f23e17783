/// How far and in how many steps places are moved, through sheets that show their backs one after another.

#include "relocate.h"

#include <gtest/gtest.h>

#include "ray_source.h"

namespace ssphh::place {
namespace {

using test::RaySource;
using test::surface_at;

/// Inside of a body up to x = `depth`, of which every ray meets a back, toward +x 0.1 m ahead; free beyond.
RaySource onion(float depth) {
  return RaySource([=](const vec3& p, const vec3& d) {
    return p.x < depth ? surface_at(0.2f - 0.1f * d.x, d, true) : surface_at(3, d);
  });
}

constexpr SiteRules rules{0.05f, 0.25f};

std::optional<Relocated> leave(const RaySource& source, float limit = 10) {
  return relocate(source, vec3(0), look_around(source, vec3(0)), rules, limit);
}

TEST(RelocateSteps, LeadPastTheNearestBackByTwoClearancesAndAreFive) {
  // Each step: to the back and 0.1 m beyond, along the fan's ray that lies nearest to +x.
  const auto one = leave(onion(0.1f));
  ASSERT_TRUE(one);
  const float back = look_around(onion(0.1f), vec3(0)).nearest_back;
  EXPECT_NEAR(back, 0.1f, 0.002f);
  EXPECT_NEAR(glm::length(one->position), back + 0.1f, 1e-5f);
  EXPECT_EQ(one->site.nearest, 3) << "seen from the new place";
  const float step = one->position.x;
  const auto five = leave(onion(4.5f * step));
  ASSERT_TRUE(five);
  EXPECT_NEAR(five->position.x, 5 * step, 1e-4f);
  EXPECT_FALSE(leave(onion(5.5f * step))) << "a sixth would have been needed";
}

TEST(RelocateSteps, EndAtTheLimit) {
  const float way = glm::length(leave(onion(0.1f))->position);
  EXPECT_TRUE(leave(onion(0.1f), 1.001f * way));
  EXPECT_FALSE(leave(onion(0.1f), 0.999f * way));
}

TEST(RelocateSteps, OffASurfaceLeaveTwoClearancesAlongItsNormal) {
  // Of a wall x = 0: from 0.02 m before it to 2 · 0.05 m, by what the fan's nearest ray measures.
  const RaySource wall([](const vec3& p, const vec3& d) {
    rays::RayHit hit = surface_at(d.x < 0 ? p.x / -d.x : 3, d);
    if (d.x < 0) hit.normal = {1, 0, 0};
    return hit;
  });
  const vec3 close(0.02f, 1, 2);
  const Site site = look_around(wall, close);
  const auto moved = relocate(wall, close, site, rules, 1);
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->position.x, 0.02f + 0.1f - site.nearest, 1e-6f);
  EXPECT_EQ(moved->position.y, 1);
  EXPECT_EQ(moved->position.z, 2);
}

TEST(Sidestep, TakesTheNearestOfFourDistancesThatIsFreeValidAndInSight) {
  const RaySource open([](const vec3&, const vec3& d) { return surface_at(3, d); });
  for (const float share : {0.25f, 0.5f, 0.75f, 1.0f}) {
    const auto free = [&](const vec3& p) { return glm::length(p) > 2 * share - 0.01f; };
    const auto moved = sidestep(open, vec3(0), rules, 2, free);
    ASSERT_TRUE(moved);
    EXPECT_NEAR(glm::length(moved->position), 2 * share, 1e-5f);
  }
  EXPECT_FALSE(sidestep(open, vec3(0), rules, 2, [](const vec3& p) { return glm::length(p) > 2.01f; }));
  // A wall in the way toward all but +y.
  const RaySource walled([](const vec3& p, const vec3& d) {
    return surface_at(p == vec3(0) && glm::normalize(d).y < 0.99f ? 0.1f : 3, d);
  });
  const auto up = sidestep(walled, vec3(0), rules, 2, [](const vec3&) { return true; });
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->position.y, 0.5f, 1e-6f);
}

}  // namespace
}  // namespace ssphh::place
