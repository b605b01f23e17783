// Errors of looked-up irradiance in every channel and in colour, held against points worked out by hand.

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/random.h>
#include <ssphh/study/lookup_error.h>

namespace ssphh::study {
namespace {

using Truth = rays::IrradianceEstimate;

/// Noise that goes the same way in all channels.
Truth truth_of(const vec3& value, const vec3& deviation = vec3(0)) {
  return {vec3(0), value, deviation * deviation, deviation * vec3(deviation.y, deviation.z, deviation.x)};
}

double normal(Pcg32& random) {
  const vec2 u = random.uniform2();
  return static_cast<double>(std::sqrt(-2 * std::log(1 - u.x)) * std::cos(2 * pi * u.y));
}

TEST(LookupError, OfPointsByHand) {
  // One channel each: red as below, green exact and without noise, blue dark.
  const std::vector<vec3> looked_up = {{1.2f, 5, 0}, {2.7f, 5, 0}};
  const std::vector<Truth> truth = {truth_of({1, 5, 0}, {0.1f, 0, 0}), truth_of({3, 5, 0}, {0.2f, 0, 0})};
  const LookupError e = lookup_error(looked_up, truth);
  EXPECT_EQ(e.points, 2u);
  const RelativeError& red = e.channels[0];
  const double floor = 0.01 * 7 / 3;  // means of 2, 5 and 0
  EXPECT_NEAR(red.mean_truth, 2, 1e-6);
  EXPECT_NEAR(red.ratio, 3.9 / 4, 1e-6);
  EXPECT_NEAR(red.mean_relative, 0.5 * (0.2 / (1 + floor) + 0.3 / (3 + floor)), 1e-6);
  EXPECT_NEAR(red.median_relative, 0.3 / (3 + floor), 1e-6);
  EXPECT_NEAR(red.p95_relative, 0.2 / (1 + floor), 1e-6);
  EXPECT_NEAR(red.noise, 0.7978845608 * 0.5 * (0.1 / (1 + floor) + 0.2 / (3 + floor)), 1e-6);
  EXPECT_NEAR(red.mean_error, std::sqrt(red.mean_relative * red.mean_relative - red.noise * red.noise), 1e-9);
  EXPECT_NEAR(red.relmse,
              0.5 * ((0.04 - 0.01) / std::pow(1 + floor, 2) + (0.09 - 0.04) / std::pow(3 + floor, 2)), 1e-6);
  const RelativeError& green = e.channels[1];
  EXPECT_EQ(green.ratio, 1);
  EXPECT_EQ(green.mean_error, 0);
  EXPECT_EQ(green.relmse, 0);
  EXPECT_TRUE(std::isnan(e.channels[2].ratio)) << "blue is dark";
  EXPECT_EQ(e.channels[2].mean_error, 0);
}

TEST(LookupError, LuminanceIsThatOfTheColoursWithItsOwnFloor) {
  const vec3 tint(0.5f, 1, 2);
  const auto scale = static_cast<double>(luminance(tint));
  const LookupError e =
      lookup_error(std::vector<vec3>{1.2f * tint, 2.7f * tint},
                   std::vector<Truth>{truth_of(tint, 0.1f * tint), truth_of(3.0f * tint, 0.2f * tint)});
  // ε = 0.02.
  EXPECT_NEAR(e.luminance.mean_truth, 2 * scale, 1e-6);
  EXPECT_NEAR(e.luminance.ratio, 3.9 / 4, 1e-6);
  EXPECT_NEAR(e.luminance.mean_relative, 0.5 * (0.2 / 1.02 + 0.3 / 3.02), 1e-6);
  EXPECT_NEAR(e.luminance.noise, 0.7978845608 * 0.5 * (0.1 / 1.02 + 0.2 / 3.02), 1e-6);
  EXPECT_NEAR(e.chromaticity.mean, 0, 1e-6) << "brightness alone";
  EXPECT_NEAR(e.chromaticity.noise, 0, 1e-6) << "which goes the same way in all channels";
}

TEST(LookupError, AChannelThatIsLostIsSeenWhereLuminanceIsRight) {
  // Red light that comes back grey, of the same luminance.
  const vec3 red(1, 0.1f, 0.1f);
  const vec3 grey(luminance(red));
  const LookupError e = lookup_error(std::vector<vec3>(4, grey), std::vector<Truth>(4, truth_of(red)));
  EXPECT_NEAR(e.luminance.ratio, 1, 1e-6);
  EXPECT_LT(e.luminance.mean_error, 1e-6);
  EXPECT_NEAR(e.channels[0].ratio, static_cast<double>(grey.x), 1e-6);
  EXPECT_NEAR(e.channels[2].ratio, 10 * static_cast<double>(grey.x), 1e-5);
  EXPECT_EQ(worst_channel(e).ratio, e.channels[1].ratio) << "2.9 is farther from 1 than 0.29";
  // c of the truth is 10/12, 1/12, 1/12; ε = 0.004.
  const double wanted = 1.2 / (1.2 + 0.012) * (10.0 / 12 - 1.0 / 3 + 2 * (1.0 / 3 - 1.0 / 12));
  EXPECT_NEAR(e.chromaticity.mean, wanted, 1e-6);
  EXPECT_NEAR(e.chromaticity.mean_error, wanted, 1e-6);
  EXPECT_NEAR(e.chromaticity.p95, wanted, 1e-6);
}

TEST(LookupError, WhereNothingWasLookedUpTheColourIsGrey) {
  const LookupError e = lookup_error(std::vector<vec3>{vec3(0), vec3(0)},
                                     std::vector<Truth>{truth_of(vec3(1)), truth_of({3, 0, 0})});
  // Grey is right at the first, at the second 1 is 1/3, twice 0 is 1/3; ε = 0.02, of a mean of 1 + 0.5 + 0.5
  // + …
  const double floor = 0.01 * (4 + 1 + 1) / 6;
  EXPECT_NEAR(e.chromaticity.mean, 0.5 * 3 / (3 + 3 * floor) * 4 / 3, 1e-6);
  EXPECT_EQ(e.channels[0].ratio, 0);
}

TEST(LookupError, DarkPointsHardlyHaveAColour) {
  std::vector<vec3> looked_up(100, vec3(1));
  std::vector<Truth> truth(100, truth_of(vec3(1)));
  looked_up[7] = {1e-6f, 0, 0}, truth[7] = truth_of({0, 0, 1e-6f});
  EXPECT_LT(lookup_error(looked_up, truth).chromaticity.mean, 1e-5);
  looked_up[7] = {1, 0, 0}, truth[7] = truth_of({0, 0, 1});
  EXPECT_NEAR(lookup_error(looked_up, truth).chromaticity.mean, 0.02, 1e-3);
}

TEST(LookupError, MedianAndNinetyFifthPercentileAreRanksOfThePoints) {
  // Points that are 1, 2, … 1000 thousandths too bright, in no order; ε = 1 %.
  std::vector<vec3> looked_up;
  for (int i = 0; i < 1000; ++i) looked_up.emplace_back(1 + 1e-3f * static_cast<float>(i * 7 % 1000 + 1));
  const LookupError e = lookup_error(looked_up, std::vector<Truth>(1000, truth_of(vec3(1))));
  for (const RelativeError& error : {e.channels[0], e.channels[2], e.luminance}) {
    EXPECT_NEAR(error.median_relative, 0.500 / 1.01, 1e-4);
    EXPECT_NEAR(error.p95_relative, 0.950 / 1.01, 1e-4);
  }
}

TEST(LookupError, NoiseAloneSubtractsToNothing) {
  // Lookups without error, truths with normal noise of a known variance: relMSE must vanish and mean_relative
  // equal `noise`, both within four standard errors of 20,000 points.
  constexpr int count = 20000;
  constexpr float deviation = 0.1f;
  std::vector<Truth> truth;
  Pcg32 random(7);
  for (int i = 0; i < count; ++i)
    truth.push_back(truth_of(vec3(1 + deviation * static_cast<float>(normal(random))), vec3(deviation)));
  const LookupError e = lookup_error(std::vector<vec3>(count, vec3(1)), truth);
  for (const RelativeError& error : {e.channels[0], e.channels[1], e.channels[2], e.luminance}) {
    EXPECT_NEAR(error.ratio, 1, 4 * 0.1 / std::sqrt(count));
    // Dividing by the noisy truth biases both by about 3 σ² of themselves.
    EXPECT_NEAR(error.relmse, 0, 4 * 0.01 * std::sqrt(2.0 / count) + 3 * 0.01 * 0.01);
    EXPECT_LT(error.mean_error, 0.3 * error.noise) << "what is left of 5 % of mean_relative";
    EXPECT_NEAR(error.mean_relative / error.noise, 1, 4 * 0.76 / std::sqrt(count) + 0.03);
  }
}

TEST(LookupError, ColouredNoiseOfSharedPathsSubtractsToNothing) {
  // Paths that all bring their light by way of one red wall and leave with another tint: the noise is a
  // multiple of one colour, which is not the mean's.
  constexpr int count = 20000;
  const vec3 mean(1, 0.8f, 0.6f), tint(0.1f, 0.02f, 0.01f);
  std::vector<Truth> truth;
  Pcg32 random(3);
  for (int i = 0; i < count; ++i)
    truth.push_back(truth_of(mean + static_cast<float>(normal(random)) * tint, tint));
  const ChromaticityError e = lookup_error(std::vector<vec3>(count, mean), truth).chromaticity;
  EXPECT_GT(e.mean, 0.03);
  EXPECT_NEAR(e.mean / e.noise, 1, 4 * 0.76 / std::sqrt(count) + 0.03);
  EXPECT_LT(e.mean_error, 0.3 * e.noise);
}

TEST(LookupError, NoiseOfEachChannelByItselfSubtractsToNothing) {
  // And of two that go against each other.
  constexpr int count = 20000;
  const vec3 mean(1, 0.5f, 0.8f);
  for (const bool against : {false, true}) {
    std::vector<Truth> truth;
    Pcg32 random(5);
    for (int i = 0; i < count; ++i) {
      vec3 noise(0);
      for (int c = 0; c < 3; ++c) noise[c] = 0.05f * static_cast<float>(normal(random));
      if (against) noise.y = -noise.x;
      truth.push_back({vec3(0), mean + noise, vec3(0.0025f), {against ? -0.0025f : 0.0f, 0, 0}});
    }
    const ChromaticityError e = lookup_error(std::vector<vec3>(count, mean), truth).chromaticity;
    EXPECT_GT(e.mean, 0.04);
    EXPECT_NEAR(e.mean / e.noise, 1, 4 * 0.76 / std::sqrt(count) + 0.03) << against;
    EXPECT_LT(e.mean_error, 0.3 * e.noise);
  }
}

TEST(LookupError, DarknessHasNoRatio) {
  const LookupError e = lookup_error(std::vector<vec3>(3, vec3(1)), std::vector<Truth>(3));
  EXPECT_TRUE(std::isnan(e.luminance.ratio));
  EXPECT_TRUE(std::isnan(worst_channel(e).ratio));
  EXPECT_EQ(e.luminance.relmse, 0);
  EXPECT_EQ(e.chromaticity.mean, 0);
}

TEST(LookupError, TheWorstChannelIsOneForEachFigure) {
  LookupError e;
  e.channels[0].ratio = 1.2, e.channels[1].ratio = 0.7, e.channels[2].ratio = std::nan("");
  e.channels[0].mean_error = 0.3, e.channels[1].p95_relative = 0.8, e.channels[2].median_relative = 0.25;
  for (int c = 0; c < 3; ++c) e.channels[c].relmse = -0.3 + 0.1 * c;
  e.channels[1].noise = 0.125, e.channels[2].mean_relative = 0.5;
  const RelativeError worst = worst_channel(e);
  EXPECT_EQ(worst.ratio, 0.7);
  EXPECT_EQ(worst.mean_error, 0.3);
  EXPECT_EQ(worst.p95_relative, 0.8);
  EXPECT_EQ(worst.median_relative, 0.25);
  EXPECT_EQ(worst.mean_relative, 0.5);
  EXPECT_EQ(worst.noise, 0.125);
  EXPECT_NEAR(worst.relmse, -0.1, 1e-12) << "the least that is taken off too much";
}

}  // namespace
}  // namespace ssphh::study
