// ZH3 against what it keeps exactly, a search for a nearer one, and turned axes.

#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/math.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/zh3.h>
#include <ssphh/sh/zonal.h>

#include "error_message.h"
#include "random_sh.h"

namespace ssphh::sh {
namespace {

/// Mean square over directions, times 4π, of the difference in bands 0 to 2.
double apart(const RadianceSh& a, const RadianceSh& b) {
  double sum = 0;
  for (int k = 0; k < 9; ++k) {
    const glm::dvec3 d = glm::dvec3(a[k]) - glm::dvec3(b[k]);
    sum += glm::dot(d, d);
  }
  return sum;
}

TEST(Zh3, ALobeAboutOneAxisLosesNothing) {
  Pcg32 random(1);
  for (int i = 0; i < 50; ++i) {
    std::vector<float> lobe(9);
    rotate_zonal({1.0, 0.8, 0.5}, vec3(test::random_direction(random)), lobe);
    RadianceSh f(2);
    for (int k = 0; k < 9; ++k) f[k] = lobe[k] * vec3(1, 2, 0.5f);
    EXPECT_LT(apart(to_sh(zh3_from(f)), f), 1e-11);
  }
}

TEST(Zh3, KeepsBandsZeroAndOne) {
  const RadianceSh f = test::random_sh(4, 2), g = to_sh(zh3_from(f));
  EXPECT_EQ(g.degree(), 2);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(g[k], f[k]);
}

TEST(Zh3, NoOtherLobeAboutTheAxisIsNearer) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RadianceSh f = test::random_sh(2, seed);
    const Zh3 best = zh3_from(f);
    const double least = apart(to_sh(best), f);
    for (const float step : {-0.01f, 0.01f}) {
      for (int c = 0; c < 3; ++c) {
        Zh3 other = best;
        other.zonal[c] += step;
        // The lobe is a unit vector, so a step from the best adds its square.
        EXPECT_NEAR(apart(to_sh(other), f) - least, 1e-4, 1e-6);
      }
    }
  }
}

TEST(Zh3, ItsErrorIsThatOfTheTurnedFunction) {
  Pcg32 random(3);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RadianceSh f = test::random_sh(2, seed);
    const quat turn = glm::angleAxis(6 * random.uniform(), vec3(test::random_direction(random)));
    const RadianceSh turned = rotate(f, turn);
    EXPECT_NEAR(apart(to_sh(zh3_from(turned)), turned), apart(to_sh(zh3_from(f)), f), 1e-5) << seed;
    EXPECT_LT(apart(to_sh(zh3_from(turned)), rotate(to_sh(zh3_from(f)), turn)), 1e-8) << seed;
  }
}

TEST(Zh3, WithoutAnAxisBandTwoIsLeftOut) {
  RadianceSh f = test::random_sh(2, 9);
  for (int k = 1; k < 4; ++k) f[k] = vec3(0);
  EXPECT_FALSE(zh3_axis({f[0], f[1], f[2], f[3]}));
  EXPECT_EQ(zh3_from(f).zonal, vec3(0));
  EXPECT_THROW(zh3_from(RadianceSh(1)), Error);
}

}  // namespace
}  // namespace ssphh::sh
