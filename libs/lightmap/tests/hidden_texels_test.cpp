// What texels within bodies and beside them show.

#include <map>

#include <gmock/gmock.h>

#include "rooms.h"
#include "triangle_source.h"

namespace ssphh::lightmap {
namespace {

TEST(Atlas, TexelsWithinOrUnderABodyTakeTheLightAroundIt) {
  // A box of 1 m stands in the middle of a floor of 4 m and reaches a little below it; one of a centimetre's
  // gap lies over a corner.
  const scene::Scene scene = scene_of({scene::make_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}),
                                       scene::make_box({-0.5f, -0.1f, -0.5f}, {0.5f, 1, 0.5f}),
                                       scene::make_box({1.4f, 0.01f, 1.4f}, {2.2f, 0.3f, 2.2f})});
  const Unwrapped u(scene, {.density = 12.0f});
  const test::TriangleSource source(scene);
  const auto within = [](const vec3& p, float low, float high) {
    return p.x > low && p.x < high && p.z > low && p.z < high && p.y > -0.05f && p.y < 0.005f;
  };
  const Places places = find_places(u.texels, rays::PosedWorld(source, 0));
  std::size_t floor = 0;
  const float texel = 1 / 12.0f;
  for (std::size_t i = 0; i < u.texels.first[1]; ++i) {
    const vec3 p = places.points[i].position;
    if (within(p, -0.5f, 0.5f) || within(p, 1.4f + texel, 2.1f)) {
      EXPECT_TRUE(places.hidden[i]) << p.x << ' ' << p.z;
    }
    const bool far = !within(p, -0.5f - texel, 0.5f + texel) && !within(p, 1.4f - texel, 2.2f);
    if (far) {
      EXPECT_FALSE(places.hidden[i]) << p.x << ' ' << p.z;
    }
    floor += places.hidden[i];
  }
  EXPECT_GT(floor, 100u);
  const image::Image atlas = light_texels(u.texels, places, [&](const rays::SurfacePoint& at) {
    return within(at.position, -0.5f, 0.5f) || within(at.position, 1.45f, 2.1f) ? vec3(1000) : vec3(1, 2, 3);
  });
  for (std::size_t i = 0; i < u.texels.first[1]; ++i) {
    EXPECT_NEAR(value_of(atlas, u.texels.texels[i].index).z, 3, 1e-4f);
  }
}

TEST(Atlas, WhatLiesBetweenTwoBodiesThatTouchIsAsBrightAsWhatIsBesideIt) {
  // A wall of two pieces with light on one of its sides, and a step between them that lies open: a crack
  // shows their ends.
  const scene::Scene scene =
      scene_of({scene::make_box({-3, 0, 0}, {0, 3, 0.2f}), scene::make_box({0, 0, 0}, {3, 2, 0.2f})});
  const Unwrapped u(scene, {.density = 12.0f});
  const test::TriangleSource source(scene);
  const image::Image atlas = u.atlas(
      [](const rays::SurfacePoint& at) {
        return at.position.y > 2.01f ? vec3(5) : at.position.z > 0.1f ? vec3(1) : vec3(3);
      },
      source);
  std::size_t ends = 0;
  for (const Face& face : u.texels.faces) {
    if (std::abs(face.position[0].x) + std::abs(face.position[1].x) + std::abs(face.position[2].x) > 1e-3f)
      continue;
    for (const vec3& share : shares()) {
      const vec3 at = point(face.position, share);
      if (at.y > 1.8f || at.y < 0.1f || (at.z > 0.01f && at.z < 0.19f)) continue;
      EXPECT_NEAR(u.looked_up(atlas, face, share).x, at.z > 0.1f ? 1 : 3, 1e-4f) << at.y << ' ' << at.z;
      ++ends;
    }
  }
  EXPECT_GE(ends, 8u);
}

TEST(Atlas, AThinWallLetsNoLightUnderItsFoot) {
  // Of a floor with a wall that is a little thicker than a texel, dark before it and bright behind.
  const scene::Scene scene = scene_of(
      {scene::make_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), scene::make_box({-2, 0, -0.1f}, {2, 3, 0.1f})});
  for (const float density : {6.0f, 8.0f}) {
    const Unwrapped u(scene, {.density = density});
    const test::TriangleSource source(scene);
    const image::Image atlas =
        u.atlas([](const rays::SurfacePoint& at) { return vec3(at.position.z > 0 ? 1 : 100); }, source);
    for (std::size_t f = 0; f < 2; ++f) {
      for (float a = 0; a <= 1; a += 0.01f) {
        for (float b = 0; a + b <= 1; b += 0.01f) {
          const vec3 share(a, b, 1 - a - b), at = point(u.texels.faces[f].position, share);
          if (at.z > 0.1f) {
            EXPECT_NEAR(u.looked_up(atlas, u.texels.faces[f], share).x, 1, 1e-3f) << at.z;
          }
        }
      }
    }
  }
}

TEST(Atlas, EdgesOfShadowsAreSpreadOverHalfATexel) {
  // Light on one side of a slanted line. A third of a texel from it and more it is as it was; along it there
  // are four steps to a texel, and not one.
  const Unwrapped u(scene_of({scene::make_quad({0, 0, 0}, {4, 0, 0}, {0, 0, -4})}), {.density = 16.0f});
  const auto beyond = [](const vec3& at) { return 16 * (at.x + 0.61f * at.z - 0.3f); };  // texels
  const Places places = find_places(u.texels, rays::PosedWorld(open_space, 0));
  const image::Image atlas = light_texels(
      u.texels, places, [](const rays::SurfacePoint&) { return vec3(1); },
      [&](const rays::SurfacePoint& at) { return vec3(beyond(at.position) > 0 ? 4 : 0); });
  std::map<float, int> steps;
  for (std::size_t i = 0; i < u.texels.texels.size(); ++i) {
    if (u.texels.texels[i].way != vec2(0)) continue;
    const float value = value_of(atlas, u.texels.texels[i].index).x, away = beyond(places.points[i].position);
    ++steps[value];
    if (std::abs(away) > 0.3f) {
      EXPECT_EQ(value, away > 0 ? 5 : 1) << away;
    }
  }
  EXPECT_EQ(steps.size(), 5u);
  for (const float value : {2.0f, 3.0f, 4.0f}) EXPECT_GT(steps[value], 0) << value;
}

TEST(Atlas, LightWithinABodyIsNoPartOfATexelBesideIt) {
  const scene::Scene scene = scene_of(
      {scene::make_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), scene::make_box({-2, -1, -2}, {0.02f, 3, 2})});
  const Unwrapped u(scene, {.density = 6.0f});
  const test::TriangleSource source(scene);
  const Places places = find_places(u.texels, rays::PosedWorld(source, 0));
  const image::Image atlas = light_texels(
      u.texels, places, [](const rays::SurfacePoint&) { return vec3(0); },
      [](const rays::SurfacePoint& at) { return vec3(at.position.x > 0.02f ? 3 : 1000); });
  for (std::size_t i = 0; i < u.texels.first[1]; ++i) {
    const float x = places.points[i].position.x;
    if (x > -0.15f) {
      EXPECT_NEAR(value_of(atlas, u.texels.texels[i].index).x, 3, 1e-3f) << x;
    }
  }
}

TEST(Atlas, WhereNothingIsOpenAllHasTheLightOfItsPlace) {
  const Unwrapped u(scene_of({scene::make_quad({0, 0, 0}, {2, 0, 0}, {0, 0, -1})}), {.size = 32});
  Places places = find_places(u.texels, rays::PosedWorld(open_space, 0));
  std::ranges::fill(places.hidden, std::uint8_t{1});
  const image::Image atlas =
      light_texels(u.texels, places, [](const rays::SurfacePoint&) { return vec3(3); });
  for (const Texel& texel : u.texels.texels) EXPECT_NEAR(value_of(atlas, texel.index).x, 3, 1e-5f);
}

TEST(Atlas, PlacesOfNarrowChartsLieBesideTheirTexels) {
  // Of the triangles of a bar one is a texel wide and a hundred long: a place off its border lies a tenth of
  // a texel off, and not far along it.
  const Unwrapped u(scene_of({scene::make_box({0, 0, 0}, {10, 0.13f, 0.11f})}), {.density = 10.0f});
  ASSERT_GT(u.texels.texels.size(), 400u);
  for (const Texel& texel : u.texels.texels) EXPECT_LT(glm::length(texel.way), 1.65f);
}

}  // namespace
}  // namespace ssphh::lightmap
