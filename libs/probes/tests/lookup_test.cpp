#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/sh/zonal.h>

#include "expect_near.h"
#include "fake_source.h"
#include "random_set.h"
#include "root_4pi.h"

namespace ssphh::probes {
namespace {

using test::expect_near;
using test::FakeSource;

using test::root_4pi;

/// L(ω) = a + b·ω.
sh::RadianceSh linear(int degree, const vec3& a, const vec3& b) {
  sh::RadianceSh f(degree);
  f[0] = root_4pi * a;
  if (degree == 0) return f;
  const float scale = std::sqrt(4 * pi / 3);
  f[1] = vec3(scale * b.y), f[2] = vec3(scale * b.z), f[3] = vec3(scale * b.x);
  return f;
}

struct Placed {
  vec3 position;
  sh::RadianceSh reflected, emitted;
};

ProbeSet make_set(const std::vector<Placed>& probes) {
  ProbeSet set;
  set.degree = probes.front().reflected.degree();
  set.light_groups.push_back({"lamp", vec3(1)});
  for (const Placed& placed : probes) {
    Probe& probe = set.probes.emplace_back();
    probe.position = placed.position;
    probe.groups.push_back({placed.emitted, placed.reflected});
  }
  merge_groups(set);
  return set;
}

std::vector<vec3> directions() {
  std::vector<vec3> result;
  for (int i = 0; i < 40; ++i) result.push_back(spherical_fibonacci(i, 40));
  return result;
}

/// Float rounding of a few dozen terms of size 1 to 10.
constexpr float rounding = 2e-5f;

TEST(IrradianceLookup, AConstantFieldGivesPiTimesItEverywhere) {
  const FakeSource source;
  const vec3 l(1, 2, 0.5f);
  const auto field = linear(9, l, vec3(0));
  const IrradianceLookup lookup(
      make_set({{{0, 0, 0}, field, {}}, {{2, 0, 0}, field, {}}, {{0, 3, 1}, field, {}}}), source);
  for (const vec3& n : directions()) {
    expect_near(lookup.irradiance({3.0f * n, n}), pi * l, rounding);
    for (const float roughness : {0.0f, 0.3f, 1.0f})
      expect_near(lookup.glossy({n, n}, n, roughness), l, rounding);
  }
}

TEST(IrradianceLookup, ALinearSkyGivesItsClosedForm) {
  // E(n) = πa + (2π/3) b·n; a glossy lobe keeps a and scales b by its band 1.
  const FakeSource source;
  const vec3 a(1.2f), b(0.3f, -0.5f, 0.6f), tint(1, 0.4f, 1.5f);
  for (const int degree : {1, 2, 9, 10}) {
    sh::RadianceSh sky = linear(degree, a, b);
    sky *= tint;
    const IrradianceLookup lookup(make_set({{{0, 0, 0}, sky, {}}}), source);
    for (const vec3& n : directions()) {
      expect_near(lookup.irradiance({{1, 1, 1}, n}), tint * (pi * a + 2 * pi / 3 * glm::dot(b, n)), rounding);
      const float scale = sh::glossy_band_scale(0.5f, 1);
      expect_near(lookup.glossy({{1, 1, 1}, n}, n, 0.5f), tint * (a + scale * glm::dot(b, n)), rounding);
    }
  }
}

LookupParams by_distance() {
  LookupParams params;
  params.weights.method = WeightMethod::distance;
  return params;
}

TEST(IrradianceLookup, WeighsByInverseSquaredDistance) {
  const FakeSource source;
  const IrradianceLookup lookup(
      make_set({{{0, 0, 0}, linear(2, vec3(1), vec3(0)), {}}, {{3, 0, 0}, linear(2, vec3(5), vec3(0)), {}}}),
      source, by_distance());
  const vec3 up(0, 1, 0);
  expect_near(lookup.irradiance({{1.5f, 0, 0}, up}), vec3(pi * 3), rounding);
  expect_near(lookup.irradiance({{1, 0, 0}, up}), vec3(pi * (1 * 4 + 5 * 1) / 5.0f), rounding);
  expect_near(lookup.irradiance({{3, 0, 0}, up}), vec3(pi * 5), rounding);
}

TEST(IrradianceLookup, AProbeInFrontCountsMoreThanOneBehind) {
  const FakeSource source;
  const IrradianceLookup lookup(
      make_set({{{0, 1, 0}, linear(2, vec3(1), vec3(0)), {}}, {{0, -1, 0}, linear(2, vec3(5), vec3(0)), {}}}),
      source, by_distance());
  // Wrapped cosines squared 1 and 0, each plus 0.05.
  expect_near(lookup.irradiance({{0, 0, 0}, {0, 1, 0}}), vec3(pi * (1 * 1.05f + 5 * 0.05f) / 1.1f), rounding);
}

TEST(IrradianceLookup, AHiddenProbeDoesNotLeakAndTheLookupReachesPastIt) {
  FakeSource source;
  source.free = [](const vec3& a, const vec3& b) { return (a.x < 1) == (b.x < 1); };
  // The near probe stands behind the wall x = 1.
  const IrradianceLookup lookup(make_set({{{1.1f, 0, 0}, linear(2, vec3(100), vec3(0)), {}},
                                          {{-5, 0, 0}, linear(2, vec3(1), vec3(0)), {}}}),
                                source, by_distance());
  expect_near(lookup.irradiance({{0.9f, 0, 0}, {-1, 0, 0}}), vec3(pi), rounding);
  expect_near(lookup.glossy({{0.9f, 0, 0}, {-1, 0, 0}}, {0, 1, 0}, 0.2f), vec3(1), rounding);
}

TEST(IrradianceLookup, WithoutAVisibleProbeTheNearestOnesServe) {
  FakeSource source;
  source.free = [](const vec3&, const vec3&) { return false; };
  const auto set =
      make_set({{{0, 0, 0}, linear(2, vec3(1), vec3(0)), {}}, {{9, 0, 0}, linear(2, vec3(1), vec3(0)), {}}});
  expect_near(IrradianceLookup(set, source).irradiance({{1, -5, 0}, {0, 1, 0}}), vec3(pi), rounding);
  expect_near(LightLookup(set, source).irradiance({{1, -5, 0}, {0, 1, 0}}), vec3(pi), rounding);
}

TEST(IrradianceLookup, HiddenProbesBelowTheTangentPlaneGiveNothing) {
  // A roof at y = 0: all probes but one stand in the room under it, and none sees the roof's upper side.
  FakeSource source;
  source.free = [](const vec3&, const vec3&) { return false; };
  const auto room = make_set(
      {{{0, -1, 0}, linear(2, vec3(100), vec3(0)), {}}, {{2, -1, 0}, linear(2, vec3(100), vec3(0)), {}}});
  const vec3 up(0, 1, 0);
  for (const WeightMethod method : {WeightMethod::distance, WeightMethod::trilinear, WeightMethod::mls}) {
    LookupParams params;
    params.weights.method = method;
    const IrradianceLookup lookup(room, source, params);
    expect_near(lookup.irradiance({{0.5f, 0, 0}, up}), vec3(0), rounding);
    expect_near(lookup.glossy({{0.5f, 0, 0}, up}, up, 0.5f), vec3(0), rounding);
    expect_near(lookup.irradiance({{0.5f, 0, 0}, -up}), vec3(100 * pi), 1e-3f);
  }
  // One above it as far away as one below: wrapped cosines squared 1 and 0, each plus 0.05; the first counts.
  const auto both = make_set(
      {{{0, -1, 0}, linear(2, vec3(100), vec3(0)), {}}, {{0, 1, 0}, linear(2, vec3(1), vec3(0)), {}}});
  expect_near(IrradianceLookup(both, source, by_distance()).irradiance({{0, 0, 0}, up}),
              vec3(pi * 1.05f / 1.1f), rounding);
}

TEST(IrradianceLookup, BlendsTheNearestVisibleProbesOnly) {
  const FakeSource source;
  std::vector<Placed> probes;
  for (int i = 0; i < 40; ++i) {
    probes.push_back(
        {{static_cast<float>(40 - i), 0, 0}, linear(0, vec3(static_cast<float>(i)), vec3(0)), {}});
  }
  LookupParams params = by_distance();
  params.weights.nearest = 2;
  const IrradianceLookup lookup(make_set(probes), source, params);
  // Probes 39 and 38 at distances 1 and 2 from the origin.
  expect_near(lookup.irradiance({{0, 0, 0}, {0, 1, 0}}), vec3(pi * (39 * 4 + 38) / 5.0f), 1e-3f);
}

TEST(IrradianceLookup, RaysStartOffTheSurfaceAndScaleWithTheScene) {
  for (const float scale : {1.0f, 1000.0f}) {
    std::vector<vec3> starts;
    FakeSource source;
    source.free = [&](const vec3& a, const vec3&) {
      starts.push_back(a);
      return true;
    };
    const auto field = linear(2, vec3(1), vec3(0));
    const IrradianceLookup lookup(
        make_set({{{0, 2 * scale, 0}, field, {}}, {{2 * scale, 2 * scale, 0}, field, {}}}), source,
        by_distance());
    lookup.irradiance({{0, 0, 0}, {0, 1, 0}});
    ASSERT_EQ(starts.size(), 2u);
    EXPECT_FLOAT_EQ(starts[0].y, 0.02f * scale);  // 1 % of 2 m
  }
}

TEST(IrradianceLookup, IsNeverNegativeOrNanWhateverTheLight) {
  const FakeSource source;
  Pcg32 rng(4);
  std::vector<Placed> probes;
  for (int i = 0; i < 5; ++i) probes.push_back({10.0f * rng.uniform3(), test::random_sh(rng, 9, 3), {}});
  probes[2].reflected[0] = vec3(-1);
  const ProbeSet set = make_set(probes);
  for (const bool dering : {true, false}) {
    LookupParams params;
    params.dering = dering;
    const IrradianceLookup irradiance(set, source, params);
    const LightLookup light(set, source, params);
    for (const vec3& n : directions()) {
      for (const vec3& x :
           {probes[0].position, probes[0].position + 1e-25f, vec3(1e15f), vec3(0), 10.0f * n}) {
        for (const rays::IndirectLight* lookup : {static_cast<const rays::IndirectLight*>(&irradiance),
                                                  static_cast<const rays::IndirectLight*>(&light)}) {
          for (const vec3& value : {lookup->irradiance({x, n}), lookup->glossy({x, n}, n, 0.1f)}) {
            EXPECT_TRUE(is_finite(value));
            EXPECT_GE(std::min({value.x, value.y, value.z}), 0.0f);
          }
        }
      }
    }
  }
}

TEST(IrradianceLookup, DeringingLiftsTheNegativeLobeInsteadOfCuttingIt) {
  // A narrow light: E(n) behind it rings below zero, is cut to 0 without the window, and positive with it.
  sh::RadianceSh spot(9);
  for (int l = 0; l <= 9; ++l)
    spot[sh::coefficient_index(l, 0)] = vec3(std::sqrt(static_cast<float>(2 * l + 1)));
  const FakeSource source;
  LookupParams raw;
  raw.dering = false;
  const IrradianceLookup cut(make_set({{{0, 0, 0}, spot, {}}}), source, raw),
      lifted(make_set({{{0, 0, 0}, spot, {}}}), source);
  int cut_to_zero = 0;
  double mean_cut = 0, mean_lifted = 0;
  for (int i = 0; i < 500; ++i) {
    const vec3 n = spherical_fibonacci(i, 500);
    cut_to_zero += cut.irradiance({{1, 0, 0}, n}).x == 0;
    mean_cut += cut.irradiance({{1, 0, 0}, n}).x / 500.0;
    mean_lifted += lifted.irradiance({{1, 0, 0}, n}).x / 500.0;
  }
  EXPECT_GT(cut_to_zero, 10);
  // The window keeps the mean of E, π·mean(L) = π/√4π; cutting adds light. Fibonacci points: 1e-3.
  EXPECT_NEAR(mean_lifted, pi / root_4pi, 1e-3);
  EXPECT_GT(mean_cut, mean_lifted + 2e-3);
}

TEST(LightLookup, GivesTheRadianceOfItsSphlWithTheCosineCancelled) {
  // I = L_S(ω)/(N·ω), ω from x to the probe, and the cosine of the rendering equation, leave ρ L: E = π L,
  // with L = a + b·ω known in closed form.
  const FakeSource source;
  const vec3 a(1.2f), b(0.3f, -0.5f, 0.6f), p(1, 2, 3);
  const LightLookup lookup(make_set({{p, linear(9, a, b), {}}}), source);
  for (const vec3& n : directions()) {
    const vec3 x = p - 2.0f * glm::normalize(n + vec3(0.3f, 0.2f, -0.1f));
    const vec3 omega = glm::normalize(p - x);
    ASSERT_GT(glm::dot(n, omega), 0.5f);
    expect_near(lookup.irradiance({x, n}), pi * (a + glm::dot(b, omega)), pi * rounding);
  }
}

TEST(LightLookup, AConstantFieldLeavesRhoLAtEveryAngle) {
  // ρ E/π with E = π L: up to 89.9° from the normal, and as the fallback behind it.
  const FakeSource source;
  const LightLookup lookup(make_set({{{0, 0, 0}, linear(9, {1, 2, 3}, vec3(0)), {}}}), source);
  for (const float angle : {0.0f, 0.7f, 1.4f, 1.569f, 1.6f, 3.1f}) {
    const vec3 n(std::sin(angle), std::cos(angle), 0);
    expect_near(lookup.irradiance({{0, -2, 0}, n}), pi * vec3(1, 2, 3), 3 * pi * rounding);
  }
}

TEST(LightLookup, TheNearestVisibleProbeAboveTheHorizonLights) {
  FakeSource source;
  source.free = [](const vec3&, const vec3& b) { return b.x < 2.5f; };
  const LightLookup lookup(make_set({{{0, -0.1f, 0}, linear(2, vec3(1), vec3(0)), {}},  // below the horizon
                                     {{3, 0.1f, 0}, linear(2, vec3(2), vec3(0)), {}},   // hidden
                                     {{0, 4, 0}, linear(2, vec3(3), vec3(0)), {}},      // the one
                                     {{0, 5, 0}, linear(2, vec3(4), vec3(0)), {}}}),
                           source);
  expect_near(lookup.irradiance({{0, 0, 0}, {0, 1, 0}}), vec3(3 * pi), pi * rounding);
  expect_near(lookup.glossy({{0, 0, 0}, {0, 1, 0}}, {1, 0, 0}, 0.5f), vec3(3), rounding);
}

TEST(Lookup, LightSeenDirectlyDoesNotCountTwice) {
  const FakeSource source;
  const auto set = make_set({{{0, 0, 0}, linear(2, vec3(1), vec3(0)), linear(2, vec3(10), vec3(0))}});
  LookupParams all;
  all.light = ProbeLight::all;
  expect_near(IrradianceLookup(set, source).irradiance({{1, 0, 0}, {0, 1, 0}}), vec3(pi), rounding);
  expect_near(IrradianceLookup(set, source, all).irradiance({{1, 0, 0}, {0, 1, 0}}), vec3(11 * pi), 1e-4f);
}

TEST(Lookup, LayersAreOwnNeighboursAndTheirSum) {
  const FakeSource source;
  auto set = make_set({{{0, 0, 0}, linear(2, vec3(1), vec3(0)), linear(2, vec3(10), vec3(0))}});
  LookupParams params;
  params.layer = ProbeLayer::sum;
  EXPECT_THROW(IrradianceLookup(set, source, params), Error);
  set.hierarchy.emplace();
  set.hierarchy->neighbor = {linear(2, vec3(4), vec3(0))};
  set.hierarchy->sum = {set.probes[0].self};
  set.hierarchy->sum[0] += set.hierarchy->neighbor[0];
  const auto e = [&](std::optional<ProbeLayer> layer) {
    params.layer = layer;
    return IrradianceLookup(set, source, params).irradiance({{1, 0, 0}, {0, 1, 0}}).x / pi;
  };
  EXPECT_NEAR(e(ProbeLayer::self), 1, rounding);
  EXPECT_NEAR(e(ProbeLayer::neighbor), 4, rounding);
  EXPECT_NEAR(e(ProbeLayer::sum), 5, rounding);
  EXPECT_NEAR(e(std::nullopt), 5, rounding);
}

TEST(IrradianceLookup, NarrowLobesTakeNothingAwayOfProbesThatCountNegative) {
  struct Extrapolated final : LookupWeights {
    ProbeWeights at(const rays::SurfacePoint&) const override {
      ProbeWeights weights;
      weights.add(0, 1.2f), weights.add(1, -0.5f), weights.add(2, 0.2f);
      return weights;
    }
    std::size_t bytes() const override { return 0; }
  };
  const vec3 dim(1, 2, 0.5f), other(3, 1, 2);
  const ProbeSet set = make_set({{{0, 0, 0}, linear(3, dim, vec3(0)), {}},
                                 {{2, 0, 0}, linear(3, vec3(10), vec3(0)), {}},
                                 {{4, 0, 0}, linear(3, other, vec3(0)), {}}});
  const IrradianceLookup lookup(set, std::make_shared<const Extrapolated>());
  const vec3 n(0, 1, 0);
  expect_near(lookup.glossy({vec3(1), n}, n, 0.3f), 0.9f * (1.2f * dim + 0.2f * other) / 1.4f, rounding);
  expect_near(lookup.irradiance({vec3(1), n}), glm::max(pi * (1.2f * dim - vec3(5) + 0.2f * other), vec3(0)),
              rounding);
}

TEST(Lookup, AnEmptySetIsAnError) {
  const FakeSource source;
  EXPECT_THROW(make_lookup(LookupMethod::light, ProbeSet(), source), Error);
  EXPECT_THROW(make_lookup(LookupMethod::irradiance, ProbeSet(), source), Error);
}

}  // namespace
}  // namespace ssphh::probes
