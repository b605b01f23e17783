/// What a place sees, and which places are good: every threshold from both sides.

#include <gtest/gtest.h>

#include <ssphh/place/site.h>

#include "ray_source.h"

namespace ssphh::place {
namespace {

using test::RaySource;
using test::surface_at;

/// Backs within the cap around +z of so large a share of the sphere, fronts around it, all `distance` away;
/// nothing below the plane z = `horizon`.
RaySource cap_of_backs(float share, float distance = 2, float horizon = -1) {
  return RaySource([=](const vec3&, const vec3& d) {
    if (d.z < horizon) return rays::RayHit{};
    return surface_at(distance, d, d.z > 1 - 2 * share);
  });
}

/// 128 rays in bands of equal solid angle: shares are right to one ray.
constexpr float one_ray = 1.0f / 128;

TEST(Site, TellsTheShareOfBacksAmongTheSurfacesSeen) {
  for (const float share : {0.0f, 0.1f, 0.4f, 1.0f}) {
    const Site all = look_around(cap_of_backs(share), vec3(0));
    EXPECT_NEAR(all.back, share, one_ray);
    EXPECT_EQ(all.escaped, 0);
    EXPECT_NEAR(all.harmonic, 2, 1e-5f);
    // Half the view open: what escapes is no surface.
    const Site half = look_around(cap_of_backs(0.5f * share, 2, 0), vec3(0));
    EXPECT_NEAR(half.back, share, 2 * one_ray);
    EXPECT_NEAR(half.escaped, 0.5f, one_ray);
    EXPECT_NEAR(half.harmonic, 4, 0.1f) << "what escapes is infinitely far, and counts in the mean";
  }
}

TEST(Site, FindsTheNearestSurfaceAndTheNearestBack) {
  // Fronts come nearest toward +x, backs, below, toward −z.
  const RaySource source([](const vec3&, const vec3& d) {
    return d.z < -0.5f ? surface_at(4 + d.z, d, true) : surface_at(2 - d.x, d);
  });
  const Site site = look_around(source, vec3(3, 4, 5));
  EXPECT_NEAR(site.nearest, 1, 0.03f);
  EXPECT_NEAR(site.nearest_hit.x, 1, 0.05f);
  EXPECT_LT(site.nearest_normal.x, -0.97f);
  EXPECT_NEAR(site.nearest_back, 3, 0.03f);
  EXPECT_NEAR(site.nearest_back_hit.z, -3, 0.1f);
  EXPECT_FALSE(site.emitter);
  const RaySource one_shines([](const vec3&, const vec3& d) {
    rays::RayHit hit = surface_at(2, d);
    if (d.y > 0.9f) hit.emission = vec3(0, 0, 0.1f);
    return hit;
  });
  EXPECT_TRUE(look_around(one_shines, vec3(0)).emitter);
}

TEST(Site, MoreThanItsLimitOfBacksIsInsideAndLessThanTheClearanceIsTooClose) {
  const SiteRules rules{0.1f, 0.25f};
  Site site;
  site.nearest = 0.1f, site.back = 0.25f;
  EXPECT_TRUE(valid(site, rules));
  site.back = 0.2501f;
  EXPECT_TRUE(inside_body(site, rules));
  EXPECT_FALSE(valid(site, rules));
  site.back = 0, site.nearest = 0.0999f;
  EXPECT_FALSE(inside_body(site, rules));
  EXPECT_FALSE(valid(site, rules));
}

TEST(Site, TheLimitRisesByWhatPlacesOfInterestSee) {
  // Each place sees as many backs as its x says; beyond 1 it sees nothing at all.
  const RaySource source([](const vec3& p, const vec3& d) {
    return p.x > 1 ? rays::RayHit{} : surface_at(2, d, d.z > 1 - 2 * p.x);
  });
  const auto limit = [&](const std::vector<vec3>& interest) {
    return calibrated_back_limit(source, interest);
  };
  const vec3 clean(0), some(0.3f, 0, 0), many(0.5f, 0, 0), most(0.7f, 0, 0), open(2, 0, 0);
  EXPECT_EQ(limit({}), 0.25f);
  EXPECT_EQ(limit({open}), 0.25f);
  EXPECT_EQ(limit({clean}), 0.25f);
  EXPECT_NEAR(limit({some}), 0.55f, one_ray);
  for (const std::vector<vec3>& order : {std::vector<vec3>{clean, many, some, open, open},
                                         {some, clean, many},
                                         {open, many, some, clean},
                                         {many, clean, some}})
    EXPECT_NEAR(limit(order), 0.55f, one_ray) << "the median of those that see anything";
  EXPECT_EQ(limit({clean, most, clean}), 0.25f) << "one lamp in a wall";
  EXPECT_NEAR(limit({vec3(0.63f, 0, 0)}), 0.88f, one_ray);
  EXPECT_EQ(limit({most}), 1) << "the surfaces do not tell";
}

}  // namespace
}  // namespace ssphh::place
