#include <gtest/gtest.h>

#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>

#include "dark_space.h"
#include "fake_source.h"

namespace ssphh::study {
namespace {

/// A colour of luminance 1: 0.2126 · 2 + 0.7152 · 0.5 + 0.0722 · 3.0083.
const vec3 tint(2, 0.5f, 3.0083102f);

/// PlaceTruth by place: a luminance of `mean` W/m² with standard deviation `deviation`.
struct PlaceTruth {
  float mean, deviation;
};

class TruthSource final : public test::DarkSpace {
 public:
  std::function<PlaceTruth(const vec3& position, const rays::PathParams& path)> truth;
  mutable std::vector<rays::PathParams> asked;

  std::vector<rays::IrradianceEstimate> surface_irradiance(std::span<const rays::SurfacePoint> points,
                                                           const rays::PathParams& path,
                                                           const Control&) const override {
    asked.push_back(path);
    std::vector<rays::IrradianceEstimate> estimates;
    for (const rays::SurfacePoint& point : points) {
      const PlaceTruth t = truth(point.position, path);
      estimates.push_back({vec3(100), t.mean * tint, t.deviation * t.deviation * tint * tint});
    }
    return estimates;
  }
};

/// Irradiance by place.
class FakeLookup final : public rays::IndirectLight {
 public:
  explicit FakeLookup(std::function<float(const vec3&)> value) : value_(std::move(value)) {}
  vec3 irradiance(const rays::SurfacePoint& at) const override { return value_(at.position) * tint; }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return vec3(0); }

 private:
  std::function<float(const vec3&)> value_;
};

/// Points at x = 0, 1, … count − 1.
std::vector<rays::SurfacePoint> row(int count) {
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < count; ++i) points.push_back({{static_cast<float>(i), 0, 0}, {0, 1, 0}});
  return points;
}

TEST(Leak, IsTheShareOfTheLookedUpEnergyAtDarkPoints) {
  TruthSource source;
  source.truth = [](const vec3& x, const rays::PathParams&) { return PlaceTruth{x.x < 6 ? 2.0f : 0.0f, 0}; };
  const FakeLookup lookup([](const vec3& x) { return x.x < 6 ? 2.0f : 0.75f; });
  const LeakReport report = measure_leak(source, lookup, row(10));
  // 6 points of 2 and 4 of 0.75: 3 of 15.
  EXPECT_NEAR(report.ratio, 0.2, 1e-6);
  EXPECT_EQ(report.dark, 4u);
  EXPECT_NEAR(report.mean_truth, 1.2, 1e-6);
  EXPECT_NEAR(report.mean_looked_up, 1.5, 1e-6);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(report.dark_at[i], i < 6 ? 0 : 1);
    EXPECT_NEAR(report.looked_up[i], i < 6 ? 2 : 0.75, 1e-6);
  }
}

TEST(Leak, APointWhoseNoiseReachesOverTheLimitIsNotDark) {
  TruthSource source;
  // Mean 1; the limit is 1e-4: 5e-5 with three deviations of 1e-5 lies below, with 2e-5 above.
  source.truth = [](const vec3& x, const rays::PathParams&) {
    if (x.x < 2) return PlaceTruth{1.5f, 0.1f};
    return PlaceTruth{5e-5f, x.x < 3 ? 1e-5f : 2e-5f};
  };
  const LeakReport report = measure_leak(source, FakeLookup([](const vec3&) { return 1.0f; }), row(4),
                                         {.dark_share = 1e-4f, .sigmas = 3, .mean = 1});
  EXPECT_EQ(report.dark_at, (std::vector<std::uint8_t>{0, 0, 1, 0}));
  EXPECT_NEAR(report.truth_noise, (2 * 0.1 + 3e-5) / (3 + 1e-4), 1e-6);
}

TEST(Leak, ALuckyPathMakesNoOtherPointDark) {
  TruthSource source;
  source.truth = [](const vec3& x, const rays::PathParams&) {
    return PlaceTruth{x.x < 1 ? 0.0f : x.x < 2 ? 1e7f : 1.0f, 0};
  };
  const LeakReport report = measure_leak(source, FakeLookup([](const vec3&) { return 1.0f; }), row(40));
  EXPECT_EQ(report.dark, 1u);
  EXPECT_NEAR(report.ratio, 1.0 / 40, 1e-6);
  EXPECT_GT(report.mean_truth, 1e5) << "which is told as it is";
}

TEST(Leak, WhatASecondLookFindsLitIsNotDark) {
  TruthSource source;
  source.truth = [](const vec3& x, const rays::PathParams& path) {
    const bool lucky = path.spp > 64;  // A rare path that the first look missed, variance and all.
    return PlaceTruth{x.x < 2 ? 1.0f : lucky && x.x < 3 ? 0.5f : 0.0f, 0};
  };
  const LeakReport report = measure_leak(source, FakeLookup([](const vec3&) { return 1.0f; }), row(4),
                                         {.path = {.max_depth = 9, .passes = 1, .spp = 64, .seed = 3}});
  EXPECT_EQ(report.dark_at, (std::vector<std::uint8_t>{0, 0, 0, 1}));
  ASSERT_EQ(source.asked.size(), 2u);
  EXPECT_EQ(source.asked[1].spp, 4 * 64);
  EXPECT_EQ(source.asked[1].max_depth, 9);
  EXPECT_NE(source.asked[1].seed, source.asked[0].seed);
}

TEST(Leak, NothingLooksUpNothing) {
  TruthSource source;
  source.truth = [](const vec3&, const rays::PathParams&) { return PlaceTruth{0, 0}; };
  const LeakReport dark = measure_leak(source, FakeLookup([](const vec3&) { return 0.0f; }), row(3));
  EXPECT_EQ(dark.ratio, 0);
  EXPECT_EQ(dark.dark, 3u);
  const LeakReport all = measure_leak(source, FakeLookup([](const vec3&) { return 1.0f; }), row(3));
  EXPECT_NEAR(all.ratio, 1, 1e-12);
}

TEST(Leak, RefusesWhatItCannotMeasure) {
  TruthSource source;
  source.truth = [](const vec3&, const rays::PathParams&) { return PlaceTruth{1, 0}; };
  const FakeLookup lookup([](const vec3&) { return 1.0f; });
  EXPECT_THROW(measure_leak(source, lookup, {}), Error);
  EXPECT_THROW(measure_leak(source, lookup, row(1), {.dark_share = 0}), Error);
  EXPECT_THROW(measure_leak(source, lookup, row(1), {.sigmas = NAN}), Error);
  EXPECT_THROW(measure_leak(test::FakeSource(), lookup, row(1)), Error) << "it cannot trace irradiance";
}

}  // namespace
}  // namespace ssphh::study
