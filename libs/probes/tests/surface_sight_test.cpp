// What counts as one surface: spacing, sight over bulges, and what stands close before a point.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/probes/lookup_constants.h>
#include <ssphh/probes/surface_interpolation.h>

#include "surface_shares.h"

namespace ssphh::probes {
namespace {

std::vector<rays::SurfacePoint> floor_grid(int side, float step, float height = 0, float up = 1) {
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j)
      points.push_back(
          {vec3(step * static_cast<float>(i), height, step * static_cast<float>(j)), {0, up, 0}});
  }
  return points;
}

std::size_t middle_of(int side) {
  return static_cast<std::size_t>(side / 2 * side + side / 2);
}

TEST(SurfaceSpacings, AreThoseAlongASurfaceWhateverIsNearIt) {
  std::vector<rays::SurfacePoint> points = floor_grid(9, 0.5f);
  EXPECT_FLOAT_EQ(surface_spacings(points)[middle_of(9)], 0.5f);
  // A board's other side, a shelf above it, and walls that cross it are nearer
  for (const rays::SurfacePoint& p : floor_grid(9, 0.5f, -0.02f, -1)) points.push_back(p);
  for (const rays::SurfacePoint& p : floor_grid(9, 0.5f, 0.4f)) points.push_back(p);
  EXPECT_NEAR(surface_spacings(points)[middle_of(9)], 0.42f, 0.04f) << "six tenths of the twelfth's";
}

TEST(SurfaceSpacings, OfAStripReachAlongIt) {
  // A window's frame, points a hand apart, between sashes and glass with many points each
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < 9; ++i) points.push_back({{0, 0.15f * static_cast<float>(i), 0}, {0, 0, 1}});
  for (const float side : {-1.0f, 1.0f})
    for (int i = 0; i < 60; ++i)
      points.push_back({{0.05f * side, 0.02f * static_cast<float>(i), 0.01f}, {side, 0, 0}});
  EXPECT_NEAR(surface_spacings(points)[4], 0.8f * 0.15f, 1e-4f);
  // Those of another room say nothing of it, however few its own are
  points.resize(2);
  points[1].position.y = 30;
  points.push_back({{0, 31, 0}, {0, 0, 1}});
  for (const rays::SurfacePoint& p : floor_grid(6, 0.5f)) points.push_back(p);
  EXPECT_LT(surface_spacings(points)[0], 4);
}

TEST(SurfaceSpacings, FollowThePointsFromPlaceToPlace) {
  std::vector<rays::SurfacePoint> points = floor_grid(11, 0.1f);
  for (rays::SurfacePoint p : floor_grid(11, 8)) points.push_back({p.position + vec3(100, 0, 0), p.normal});
  const std::vector<float> spacings = surface_spacings(points);
  EXPECT_NEAR(spacings[middle_of(11)], 0.1f, 0.1f * 0.1f);
  EXPECT_NEAR(spacings[121 + middle_of(11)], 8, 0.1f * 8);
}

TEST(SurfaceSpacings, OfALoneThingAreThoseOfWhatIsNear) {
  // A shelf's edge, narrow and alone of its kind but for one far away
  std::vector<rays::SurfacePoint> points = floor_grid(9, 0.5f);
  points.push_back({{2, 0.1f, 2}, {1, 0, 0}});
  points.push_back({{2, 0.1f, 60}, {1, 0, 0}});
  EXPECT_LT(surface_spacings(points)[81], 0.8f);
  EXPECT_GT(surface_spacings(points)[81], 0.3f);
}

TEST(SurfaceSpacings, AreNoneOfOnePlace) {
  EXPECT_TRUE(surface_spacings({}).empty());
  EXPECT_EQ(surface_spacings(floor_grid(1, 1))[0], 0);
  const std::vector<rays::SurfacePoint> twice(2, {vec3(1), {0, 1, 0}});
  EXPECT_EQ(surface_spacings(twice), (std::vector<float>{0, 0}));
}

TEST(SurfaceSpacings, OfTwoThatAlmostCoincideAreThoseOfTheOthers) {
  std::vector<rays::SurfacePoint> points = floor_grid(9, 1);
  points.push_back({points[40].position + vec3(1e-4f, 0, 0), points[40].normal});
  EXPECT_NEAR(surface_spacings(points)[40], 0.75f, 1e-3f) << "three of a metre and one of none";
  points = floor_grid(21, 1);
  for (int i = 1; i < 6; ++i)
    points.push_back({points[220].position + vec3(1e-4f * static_cast<float>(i), 0, 0), {0, 1, 0}});
  EXPECT_NEAR(surface_spacings(points)[220], 0.25f * 0.85f, 0.01f) << "0.85 m: there are corners";
}

/// Whether the segment meets the ball.
bool meets_ball(const vec3& a, const vec3& b, float radius) {
  const vec3 d = b - a;
  const float t = glm::clamp(-glm::dot(a, d) / glm::dot(d, d), 0.0f, 1.0f);
  return glm::length(a + t * d) < radius;
}

TEST(SightAlongSurface, PassesOverABallBetweenItsOwnPoints) {
  for (const float radius : {0.1f, 1.0f, 30.0f}) {
    const auto sees = [&](const vec3& a, const vec3& b) { return !meets_ball(a, b, radius); };
    const rays::SurfacePoint a{{0, radius, 0}, {0, 1, 0}};
    for (float degrees = 1; degrees <= 45; degrees += 4) {
      const vec3 n(std::sin(glm::radians(degrees)), std::cos(glm::radians(degrees)), 0);
      EXPECT_TRUE(see_along_surface(a, {radius * n, n}, 1e-3f * radius, radius, sees))
          << degrees << "° of " << radius;
    }
  }
}

TEST(SightAlongSurface, StaysCloseOverWhatIsFlatOrHollow) {
  const rays::SurfacePoint a{{0, 0, 0}, {0, 1, 0}};
  for (const vec3& n : {vec3(0, 1, 0), glm::normalize(vec3(-0.4f, 1, 0))}) {
    int asked = 0;
    const auto sees = [&](const vec3& from, const vec3& to) {
      ++asked;
      EXPECT_NEAR(glm::distance(from, a.position), fitted_lift * 0.5f, 1e-6f);
      EXPECT_NEAR(glm::distance(to, vec3(0.8f, 0, 0)), fitted_lift * 0.5f, 1e-6f);
      return true;
    };
    EXPECT_TRUE(see_along_surface(a, {{0.8f, 0, 0}, n}, 0.5f, 0, sees));
    EXPECT_EQ(asked, 1);
  }
}

TEST(SightAlongSurface, PassesOverBumpsOfCoarseTrianglesAlone) {
  const rays::SurfacePoint a{{-0.4f, 0, 0}, {0, 1, 0}}, b{{0.4f, 0, 0}, {0, 1, 0}};
  const auto over = [](float wall) {  // at x = 0
    return [wall](const vec3& from, const vec3& to) {
      return from.x * to.x > 0 || 0.5f * (from.y + to.y) > wall;
    };
  };
  EXPECT_TRUE(see_along_surface(a, b, 0.5f, 1, over(0.02f)));
  EXPECT_FALSE(see_along_surface(a, b, 0.5f, 1, over(0.05f)));
}

TEST(SightAlongSurface, GoesThroughNoSlitBelowWhatHangs) {
  const rays::SurfacePoint a{{-0.4f, 0, 0}, {0, 1, 0}}, b{{0.4f, 0, 0}, {0, 1, 0}};
  const auto below = [](float gap) {  // a curtain at x = 0
    return
        [gap](const vec3& from, const vec3& to) { return from.x * to.x > 0 || 0.5f * (from.y + to.y) < gap; };
  };
  EXPECT_FALSE(see_along_surface(a, b, 0.5f, 1, below(0.02f))) << "a door's gap";
  EXPECT_FALSE(see_along_surface(a, b, 0.5f, 1, below(0.1f)));
  EXPECT_TRUE(see_along_surface(a, b, 0.5f, 1, below(0.2f))) << "a table's edge";
  EXPECT_TRUE(see_along_surface(a, b, 0.5f, 0.07f, below(0.1f))) << "there is no more room anywhere";
  EXPECT_TRUE(see_along_surface(a, b, 0.5f, 0, below(0.02f)));
}

TEST(SightAlongSurface, RisesAsFarAsThereIsRoom) {
  const rays::SurfacePoint point{{0, 1, 0}, {0, 1, 0}};
  std::vector<float> tried;
  const auto below = [&](float ceiling) {
    return [&tried, ceiling](const vec3& from, const vec3& to) {
      EXPECT_NEAR(from.y, 1.01f, 1e-6f);
      tried.push_back(to.y - 1);
      return to.y - 1 < ceiling;
    };
  };
  EXPECT_EQ(headroom(point, 0.1f, 0.01f, below(1)), 0.1f);
  EXPECT_EQ(tried.size(), 1u);
  EXPECT_NEAR(headroom(point, 0.1f, 0.01f, below(0.05f)), 0.049f, 1e-6f);
  EXPECT_EQ(headroom(point, 0.1f, 0.01f, below(0)), 0);
  EXPECT_GT(tried.back(), 0.01f);
  EXPECT_LT(tried.back(), 0.015f);
}

/// A door that does not reach the floor: what is bright behind it does not light the floor before it.
TEST(SightAlongSurface, LightStaysBehindADoorWithAGap) {
  std::vector<rays::SurfacePoint> points;
  std::vector<RecordLight> light;
  for (int x = -8; x < 8; ++x) {
    for (int z = -8; z < 8; ++z) {
      points.push_back({{0.1f * static_cast<float>(x) + 0.05f, 0, 0.1f * static_cast<float>(z)}, {0, 1, 0}});
      light.emplace_back(0);
      light.back()[3] = vec3(x < 0 ? 1.0f : 0.01f);
    }
  }
  constexpr float gap = 0.01f, thickness = 0.02f;
  const auto sees = [](const vec3& a, const vec3& b) {
    const float at = std::clamp((thickness - a.x) / (b.x - a.x), 0.0f, 1.0f);  // on its far side
    return (a.x < 0) == (b.x < thickness) || glm::mix(a.y, b.y, at) < gap;
  };
  const SurfaceInterpolation between(points, sees);
  for (float x = thickness + 0.01f; x < 0.4f; x += 0.02f) {
    vec3 e;
    ASSERT_TRUE(between.irradiance({{x, 0, 0.03f}, {0, 1, 0}}, light, e)) << x;
    EXPECT_NEAR(e.x, 0.01f, 1e-4f) << x;
  }
}

TEST(SightAlongSurface, GoesThroughNothingOnItsWayUp) {
  // Two points of a ridge below a ceiling that is nearer than the way over the ridge is high
  const vec3 left = glm::normalize(vec3(-1, 1.2f, 0)), right = glm::normalize(vec3(1, 1.2f, 0));
  const rays::SurfacePoint a{{-0.5f, 0, 0}, left}, b{{0.5f, 0, 0}, right};
  const auto below = [](float ceiling) {
    return [ceiling](const vec3& from, const vec3& to) { return (from.y < ceiling) == (to.y < ceiling); };
  };
  EXPECT_TRUE(see_along_surface(a, b, 0.5f, 1, below(0.5f)));
  EXPECT_FALSE(see_along_surface(a, b, 0.5f, 1, below(0.05f)));
}

TEST(SurfaceCover, TellsHowNarrowItIsBeforeAPoint) {
  // A plate at a height h above all of the floor
  // Of cosine-distributed light three quarters come from within 60° of the normal.
  for (const auto& [height, cover] :
       {std::pair(0.6f, 0), {0.29f, 0}, {0.2f, 1}, {0.13f, 2}, {0.07f, 3}, {0.035f, 4}}) {
    const auto sees = [h = height](const vec3& a, const vec3& b) { return (a.y < h) == (b.y < h); };
    EXPECT_EQ(surface_cover({{3, 0, 4}, {0, 1, 0}}, 1, sees), cover) << height;
  }
  // Beside a wall half of the light comes from near by: that is no cover
  const auto wall = [](const vec3& a, const vec3& b) { return (a.x < 0) == (b.x < 0); };
  EXPECT_EQ(surface_cover({{0.001f, 0, 0}, {0, 1, 0}}, 1, wall), 0);
}

TEST(SurfaceCover, TellsOfAKerb) {
  // The lower it is and the nearer, the nearer what it lights: to a few times its height
  const auto beside = [](float height, float distance) {
    const auto sees = [&](const vec3& a, const vec3& b) {
      if ((a.x < 0) == (b.x < 0)) return true;
      const float t = a.x / (a.x - b.x);
      return a.y + t * (b.y - a.y) > height;
    };
    return surface_cover({{distance, 0, 0}, {0, 1, 0}}, 1, sees);
  };
  EXPECT_EQ(beside(0.02f, 0.002f), 3);
  EXPECT_EQ(beside(0.1f, 0.002f), 1);
  EXPECT_EQ(beside(0.02f, 0.1f), 0);
  EXPECT_EQ(beside(1, 0.002f), 0);
}

TEST(CoverFactor, FallsBeyondTheOpenDistance) {
  EXPECT_EQ(cover_factor(0, 100, 1), 1);
  for (int cover = 1; cover <= most_cover; ++cover) {
    const float open = 3.0f / static_cast<float>(1 << cover);
    EXPECT_EQ(cover_factor(cover, 0, 3), 1);
    EXPECT_NEAR(cover_factor(cover, open * open, 3), 0.5f, 1e-6f);
    EXPECT_NEAR(cover_factor(cover, 4 * open * open, 3), 1.0f / 17, 1e-6f);
  }
}

TEST(ShareBySurface, FallsWithTheAngleAndOffThePlane) {
  EXPECT_EQ(share_by_surface(0, 0, 1, 2), 1);
  EXPECT_EQ(share_by_surface(0, 0, fitted_cosine, 2), 0);
  EXPECT_EQ(share_by_surface(1, 0, -1, 2), 0);
  EXPECT_NEAR(share_by_surface(1, 0, 0.5f * (1 + fitted_cosine), 2), 0.5f, 1e-6f);
  const float most = fitted_off_plane * 2 + fitted_off_plane_slope * 3;
  EXPECT_NEAR(share_by_surface(3, -0.5f * most, 1, 2), 9.0f / 16, 1e-6f);
  EXPECT_EQ(share_by_surface(3, 1.01f * most, 1, 2), 0);
  EXPECT_EQ(share_by_surface(0, 0, 1, 0), 0) << "of a point without room";
}

TEST(SurfaceInterpolation, WhatLiesBehindAPictureDarkensNothingBesideIt) {
  // Records on a wall, those of x > 1 behind a plate a twentieth of a spacing before it
  const std::vector<rays::SurfacePoint> wall = floor_grid(9, 0.25f);
  const auto sees = [](const vec3& a, const vec3& b) {
    const float plate = 0.0125f;
    if ((a.y < plate) == (b.y < plate)) return true;
    const float t = (plate - a.y) / (b.y - a.y);
    return a.x + t * (b.x - a.x) < 1.05f;
  };
  std::vector<RecordLight> light(wall.size(), RecordLight(0));
  for (std::size_t i = 0; i < wall.size(); ++i) light[i][3] = vec3(wall[i].position.x < 1.05f ? 1.0f : 0.01f);
  const SurfaceInterpolation records(wall, sees);
  for (const float x : {0.85f, 0.95f, 1.04f}) {
    vec3 found;
    ASSERT_TRUE(records.irradiance({{x, 0, 1.1f}, {0, 1, 0}}, light, found));
    EXPECT_NEAR(found.y, 1, 0.03f) << x;
  }
}

TEST(SurfaceInterpolation, WhatAKerbLightsIsNotTheRoad) {
  // One of the records stands beside a kerb as high as a fortieth of a spacing, in the sun
  std::vector<rays::SurfacePoint> road = floor_grid(9, 0.4f);
  const float kerb = 0.01f;
  road[middle_of(9)].position.x = 1.601f;
  const auto sees = [&](const vec3& a, const vec3& b) {
    if ((a.x < 1.6f) == (b.x < 1.6f)) return true;
    const float t = (1.6f - a.x) / (b.x - a.x);
    return a.y + t * (b.y - a.y) > kerb;
  };
  std::vector<RecordLight> light(road.size(), RecordLight(0));
  for (RecordLight& l : light) l[3] = vec3(1, 2, 3);
  light[middle_of(9)][3] = vec3(80, 60, 40);
  const SurfaceInterpolation records(road, sees);
  for (const float x : {1.9f, 2.1f}) {
    vec3 found;
    ASSERT_TRUE(records.irradiance({{x, 0, 1.6f}, {0, 1, 0}}, light, found));
    EXPECT_LT(glm::distance(found / vec3(1, 2, 3), vec3(1)), 0.15f) << x << " " << found.x;
  }
}

TEST(SurfaceInterpolation, PointsOfAPlainSayLittleOfTheStreetOnIt) {
  // A street of nine by nine records on a plain, from whose bright points all of it is seen and reached
  const float step = 80;
  std::vector<rays::SurfacePoint> points = floor_grid(9, 0.5f);
  for (rays::SurfacePoint p : floor_grid(8, step)) {
    p.position += vec3(-3.37f * step, 0, -3.37f * step);
    points.push_back(p);
  }
  std::vector<RecordLight> light(points.size(), RecordLight(0));
  for (std::size_t i = 0; i < points.size(); ++i) light[i][3] = i < 81 ? vec3(1, 2, 3) : vec3(7, 6, 5);
  const SurfaceInterpolation records(points, [](const vec3&, const vec3&) { return true; });
  EXPECT_NEAR(records.spacing(81 + middle_of(8)), step, 0.4f * step);
  const auto light_at = [&](float x) {
    vec3 found(0);
    EXPECT_TRUE(records.irradiance({{x, 0, 2.1f}, {0, 1, 0}}, light, found)) << x;
    return found;
  };
  EXPECT_LT(glm::distance(light_at(2.2f), vec3(1, 2, 3)), 0.05f);
  EXPECT_LT(glm::distance(light_at(60), vec3(7, 6, 5)), 0.01f) << "beyond the reach of the street's";
}

}  // namespace
}  // namespace ssphh::probes
