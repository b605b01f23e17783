/// What a lookup takes of each probe of a ddgi grid, in closed form between two probes.

#include "field.h"

#include <gtest/gtest.h>

namespace ssphh::methods::ddgi {
namespace {

const vec3 first(1, 2, 5), second(4, 3, 1);  // irradiance of the two

/// Probes at x = 0 and x = 2 with the same light for every normal, and nothing in sight but `far` away.
DdgiField two_probes(float far = 100) {
  ProbeGrid grid;
  grid.count = {2, 1, 1};
  grid.spacing = {2, 3, 5};
  DdgiField field(grid);
  std::ranges::fill(field.irradiance_of(0), first);
  std::ranges::fill(field.irradiance_of(1), second);
  std::ranges::fill(field.moment_texel, vec2(far, far * far));
  field.bias = 0;
  return field;
}

void expect_mean(const vec3& got, double weight_of_first, double weight_of_second) {
  for (int c = 0; c < 3; ++c) {
    const double expected = (weight_of_first * double(first[c]) + weight_of_second * double(second[c])) /
                            (weight_of_first + weight_of_second);
    EXPECT_NEAR(double(got[c]), expected, 1e-4) << "channel " << c;
  }
}

/// Of a probe in the direction whose cosine with the normal is given.
double facing(double cosine) {
  const double half = 0.5 * (1 + cosine);
  return half * half + 0.2;
}

TEST(DdgiField, WeighsByPlaceBetweenProbesAndByWhereTheyStand) {
  const DdgiField field = two_probes();
  const vec3 along(1, 0, 0), across(0, 1, 0), slanted = glm::normalize(vec3(0.6f, 0, 0.8f));
  for (const float x : {0.2f, 1.0f, 1.7f}) {
    const double f = double(x) / 2;
    const auto at = [&](const vec3& n) { return field.irradiance({x, 0, 0}, n, n, n); };
    expect_mean(at(along), (1 - f) * facing(-1), f * facing(1));
    expect_mean(at(-along), (1 - f) * facing(1), f * facing(-1));
    expect_mean(at(across), (1 - f) * facing(0), f * facing(0));
    expect_mean(at(slanted), (1 - f) * facing(-0.6), f * facing(0.6));
  }
  // Beside the grid the nearest probes serve; the other one keeps a thousandth.
  expect_mean(field.irradiance({-1, 0, 0}, across, across, across), facing(0), 1e-3 * facing(0));
}

TEST(DdgiField, ShiftsPointsOffTheirSurfaceByThreeQuartersOfTheBias) {
  DdgiField field = two_probes();
  field.bias = 0.4f;
  // A fifth along the normal, the rest toward the viewer: 0.75 · 0.4 · 2 m · (0.2 n + 0.8 wo).
  const double f = (0.5 + 0.75 * 0.4 * 2 * 0.8) / 2, back = (1.5 - 0.75 * 0.4 * 2 * 0.2) / 2;
  expect_mean(field.irradiance({0.5f, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}), (1 - f) * facing(0),
              f * facing(0));
  expect_mean(field.irradiance({1.5f, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}), (1 - back) * facing(1),
              back * facing(-1));
}

TEST(DdgiField, ProbesThatDoNotSeeThePointCountByChebyshevsBoundCubed) {
  for (const bool visibility : {true, false}) {
    DdgiField field = two_probes();
    field.visibility = visibility;
    // The second sees walls at 0.5 m on average, with a variance of 0.2 m²; the point is 0.8 m away from it.
    std::ranges::fill(field.moments_of(1), vec2(0.5f, 0.45f));
    const double bound = visibility ? 0.2 / (0.2 + 0.09) : 1, f = 0.6;
    const vec3 n(1, 0, 0);
    expect_mean(field.irradiance({1.2f, 0, 0}, n, n, n), (1 - f) * facing(-1),
                f * facing(1) * bound * bound * bound);
  }
}

TEST(DdgiField, WhatIsHardlySeenCountsStillLess) {
  DdgiField field = two_probes();
  std::ranges::fill(field.moments_of(1), vec2(0.5f, 0.3f));  // variance 0.05
  const double bound = 0.05 / (0.05 + 0.09), f = 0.6, weight = facing(1) * bound * bound * bound;
  ASSERT_LT(weight, 0.2);
  const vec3 n(1, 0, 0);
  expect_mean(field.irradiance({1.2f, 0, 0}, n, n, n), (1 - f) * facing(-1),
              f * weight * weight * weight / (0.2 * 0.2));
}

TEST(DdgiField, SleepingProbesDoNotCount) {
  DdgiField field = two_probes();
  field.active[1] = 0;
  EXPECT_EQ(field.irradiance({1.9f, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}), first);
  field.active[0] = 0;
  EXPECT_EQ(field.irradiance({1.9f, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}), vec3(0));
}

TEST(DdgiField, MovedProbesAreJudgedFromWhereTheyStand) {
  DdgiField field = two_probes();
  field.position[1] = {1, 1, 0};  // straight above the point, though its place on the grid is beside
  const vec3 n(0, 1, 0);
  expect_mean(field.irradiance({1, 0, 0}, n, n, n), 0.5 * facing(0), 0.5 * facing(1));
}

TEST(DdgiLight, GlossyLightIsTheMeanRadianceAroundTheMirrorDirection) {
  DdgiField field = two_probes();
  // By normal: the z axis' texels in the middle are another light than −z in the corners.
  for (int i = 0; i < 2; ++i) {
    const std::span<vec3> texels = field.irradiance_of(i);
    for (std::size_t t = 0; t < texels.size(); ++t)
      texels[t] = t % 8 > 1 && t % 8 < 6 && t / 8 > 1 && t / 8 < 6 ? first : second;
  }
  const DdgiLight light(field);
  const rays::SurfacePoint at{{1, 0, 0}, {0, 0, -1}};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(light.irradiance(at)[c], second[c], 1e-5f);
    EXPECT_NEAR(light.glossy(at, {0, 0, 1}, 0.3f)[c], first[c] / pi, 1e-5f);
  }
}

}  // namespace
}  // namespace ssphh::methods::ddgi
