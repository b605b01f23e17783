#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/window.h>

#include "known_vectors.h"
#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;

float lowest(const vec3& v) {
  return std::min({v.x, v.y, v.z});
}

template <class F>
vec3 densest_minimum(const F& f) {
  vec3 low(INFINITY);
  for (int i = 0; i < 20000; ++i) low = glm::min(low, f(spherical_fibonacci(i, 20000)));
  return low;
}

// A narrow bright lobe on black, which rings.
RadianceSh ringing(int degree) {
  return project(degree, sphere_quadrature(200), [](const vec3& d) {
    return glm::dot(d, glm::normalize(vec3(1, 2, -1))) > 0.95f ? vec3(10, 5, 1) : vec3(0.01f);
  });
}

TEST(Window, HaveTheirStatedShapes) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (int l = 0; l <= max_degree; ++l) {
    const auto i = static_cast<std::size_t>(l);
    EXPECT_EQ(hanning_window(infinity)[i], 1.0f);
    EXPECT_EQ(lanczos_window(infinity)[i], 1.0f);
  }
  EXPECT_FLOAT_EQ(hanning_window(4)[2], 0.5f);
  EXPECT_FLOAT_EQ(lanczos_window(4)[2], 2 / pi);
  EXPECT_EQ(hanning_window(4)[0], 1.0f);
  EXPECT_EQ(hanning_window(4)[4], 0.0f);
  EXPECT_EQ(lanczos_window(1)[1], 0.0f);
}

TEST(Window, LeavesTheMeanAlone) {
  const RadianceSh sh = test::random_sh(6, 1);
  EXPECT_EQ(apply_window(sh, lanczos_window(3))[0], sh[0]);
}

TEST(Minimum, EqualsTheAnswerForKnownFunctions) {
  RadianceSh sh(2);
  sh[0] = vec3(3);
  sh[2] = vec3(1, -2, 0);  // ± z
  sh[6] = vec3(0, 0, 1);   // 3 z² − 1
  const vec3 expected(0.2820948f * 3 - 0.4886025f, 0.2820948f * 3 - 2 * 0.4886025f,
                      0.2820948f * 3 - 0.3153916f);
  EXPECT_LT(largest_difference(minimum(sh), expected), 1e-6f);
}

TEST(Minimum, IsNotAboveADenseScan) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const RadianceSh sh = test::random_sh(max_degree, seed);
    const vec3 scan = densest_minimum([&](const vec3& d) { return eval(sh, d); });
    const vec3 found = minimum(sh);
    for (int c = 0; c < 3; ++c) {
      EXPECT_LE(found[c], scan[c] + 1e-4f);
      EXPECT_GT(found[c],
                scan[c] - 0.05f);  // the scan's points are 1.4° apart: it misses the floor by this at most
    }
  }
}

TEST(Dering, GraceCathedralHasTheKnownNegativeLobe) {
  const RadianceSh grace = test::grace_cathedral();
  // The values known for these coefficients, to their last printed digit.
  EXPECT_NEAR(minimum(irradiance_from_radiance(grace)).z, -0.0096, 5e-5);
  EXPECT_NEAR(minimum(grace).z, -0.16, 5e-3);
}

TEST(Dering, MakesGraceCathedralNonNegative) {
  for (const NonNegative goal : {NonNegative::irradiance, NonNegative::radiance}) {
    const RadianceSh grace = test::grace_cathedral();
    const RadianceSh clean = dering(grace, goal);
    EXPECT_NE(clean, grace);
    EXPECT_EQ(clean[0], grace[0]);
    EXPECT_GE(lowest(densest_minimum([&](const vec3& n) { return irradiance(clean, n); })), 0);
    EXPECT_GE(lowest(densest_minimum([&](const vec3& n) { return irradiance_polynomial(clean, n); })), 0);
    if (goal == NonNegative::radiance) {
      EXPECT_GE(lowest(densest_minimum([&](const vec3& d) { return eval(clean, d); })), 0);
    }
  }
}

TEST(Dering, IsTheMildestWindowThatWorks) {
  const RadianceSh grace = test::grace_cathedral();
  const AutoWindow window = choose_window(grace);
  EXPECT_TRUE(window.reached);
  // One per mille wider already fails.
  const RadianceSh milder = apply_window(grace, lanczos_window(1.001 * window.width));
  EXPECT_LT(lowest(minimum(irradiance_from_radiance(milder))), 0);
  // Radiance needs more than irradiance.
  EXPECT_LT(choose_window(grace, NonNegative::radiance).width, window.width);
}

// What choose_window takes for granted about its 2562 samples.
TEST(Dering, SamplesLieClose) {
  std::vector<vec3> samples;
  for (int i = 0; i < 2562; ++i) samples.push_back(spherical_fibonacci(i, 2562));
  float farthest = 0;
  for (int i = 0; i < 20000; ++i) {
    Pcg32 random(7, static_cast<std::uint64_t>(i));
    const vec3 direction = sample_uniform_sphere(random.uniform2());
    float largest_cosine = -1;
    for (const vec3& sample : samples) largest_cosine = std::max(largest_cosine, glm::dot(sample, direction));
    farthest = std::max(farthest, std::acos(largest_cosine));
  }
  EXPECT_LT(farthest, 0.055f);
  EXPECT_GT(farthest, 0.03f);
}

TEST(Dering, LeavesStPetersBitForBit) {
  const RadianceSh probe = test::st_peters_basilica();
  EXPECT_GT(lowest(minimum(irradiance_from_radiance(probe))), 0.08f);
  EXPECT_EQ(choose_window(probe).width, std::numeric_limits<double>::infinity());
  EXPECT_EQ(dering(probe), probe);
}

TEST(Dering, WorksForEveryDegree) {
  for (int degree = 1; degree <= max_degree; ++degree) {
    const RadianceSh clean = dering(ringing(degree), NonNegative::radiance);
    EXPECT_GE(lowest(densest_minimum([&](const vec3& d) { return eval(clean, d); })), 0) << degree;
  }
}

TEST(Dering, LeavesBlackConstantAndEmptyAlone) {
  RadianceSh constant(3);
  constant[0] = vec3(1, 0, 2);
  for (const RadianceSh& sh : {RadianceSh(4), constant, RadianceSh()}) EXPECT_EQ(dering(sh), sh);
}

TEST(Dering, SaysWhenTheMeanItselfIsNegative) {
  RadianceSh sh(2);
  sh[0] = vec3(1, -1, 1);
  EXPECT_FALSE(choose_window(sh).reached);
  EXPECT_EQ(choose_window(sh).width, 1);
}

}  // namespace
}  // namespace ssphh::sh
