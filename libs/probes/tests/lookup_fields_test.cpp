/// Lookups in light that differs by place, direction and colour, against formulas written down here.

#include <algorithm>

#include <gmock/gmock.h>

#include <ssphh/core/sphere.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/sh/zonal.h>

#include "expect_near.h"
#include "fake_source.h"
#include "varied_light.h"

namespace ssphh::probes {
namespace {

using test::expect_near;
using test::light_at;
using test::VariedLight;

/// Float sums of some dozen terms of up to 20.
constexpr float field_rounding = 1e-4f;

/// 5³ probes 1 m apart in [0, 4]³.
std::vector<vec3> grid() {
  std::vector<vec3> places;
  for (int i = 0; i < 125; ++i) places.push_back(vec3(i % 5, i / 5 % 5, i / 25));
  return places;
}

LookupParams by(WeightMethod method) {
  LookupParams params;
  params.weights.method = method;
  return params;
}

/// Places and normals at random.
std::vector<rays::SurfacePoint> points(int count, float low, float high) {
  Pcg32 random(11);
  std::vector<rays::SurfacePoint> result;
  for (int i = 0; i < count; ++i)
    result.push_back({low + (high - low) * random.uniform3(), sample_uniform_sphere(random.uniform2())});
  return result;
}

/// Irradiance and two lobes of `lookup` are those of `expected(point)`.
template <class Expected>
void expect_light(const rays::IndirectLight& lookup, const std::vector<rays::SurfacePoint>& at,
                  const Expected& expected, float tolerance = field_rounding) {
  for (const rays::SurfacePoint& p : at) {
    SCOPED_TRACE(testing::Message() << p.position.x << ' ' << p.position.y << ' ' << p.position.z);
    const VariedLight light = expected(p);
    expect_near(lookup.irradiance(p), light.irradiance(p.normal), pi * tolerance);
    const vec3 r = glm::normalize(p.normal + vec3(0.3f, -0.2f, 0.4f));
    for (const float roughness : {0.0f, 0.6f})
      expect_near(lookup.glossy(p, r, roughness), light.glossy(r, sh::glossy_band_scales(roughness)),
                  tolerance);
  }
}

TEST(LookupFields, TrilinearGivesALinearFieldOfColouredDirectionsExactly) {
  const test::FakeSource source;
  const IrradianceLookup lookup(test::varied_set(grid(), 4, light_at), source, by(WeightMethod::trilinear));
  // A tent below 1e-4 is left out
  expect_light(
      lookup, points(60, 0.05f, 3.95f), [](const auto& p) { return light_at(p.position); }, 2e-3f);
}

TEST(LookupFields, MlsKeepsALinearFieldUpToItsRidge) {
  const test::FakeSource source;
  const IrradianceLookup lookup(test::varied_set(grid(), 4, light_at), source, by(WeightMethod::mls));
  // 4 % of what changes over a spacing (lookup_weights_test.cpp): 0.9 at most in `a`, and less in what
  // depends on direction
  expect_light(
      lookup, points(60, 1.2f, 2.8f), [](const auto& p) { return light_at(p.position); }, 0.04f * 1.3f);
}

/// The weights of the method `distance` as its page has them, of probes that are all seen.
VariedLight by_distance(const std::vector<vec3>& places, const rays::SurfacePoint& p, std::size_t count) {
  std::vector<vec3> near = places;
  std::ranges::sort(near, {}, [&](const vec3& q) { return glm::distance(q, p.position); });
  near.resize(std::min(near.size(), count));
  VariedLight sum;
  float total = 0;
  for (const vec3& q : near) {
    const vec3 d = q - p.position;
    const float wrapped = 0.5f + 0.5f * glm::dot(glm::normalize(d), p.normal);
    const float weight = (wrapped * wrapped + 0.05f) / glm::dot(d, d);
    sum = sum + weight * light_at(q), total += weight;
  }
  return (1 / total) * sum;
}

TEST(LookupFields, DistanceBlendsTheEightNearestByWrappedCosineAndInverseSquare) {
  Pcg32 random(3);
  std::vector<vec3> places;
  for (int i = 0; i < 40; ++i) places.push_back(4.0f * random.uniform3());
  const test::FakeSource source;
  for (const int nearest : {1, 3, 8}) {
    LookupParams params = by(WeightMethod::distance);
    params.weights.nearest = nearest;
    const IrradianceLookup lookup(test::varied_set(places, 3, light_at), source, params);
    expect_light(lookup, points(40, 0, 4),
                 [&](const auto& p) { return by_distance(places, p, static_cast<std::size_t>(nearest)); });
  }
}

TEST(LookupFields, DistanceTakesProbesInSightFromTheOtherSideOfAWall) {
  // A wall at x = 1.7: eight of the sixteen nearest that stand on the point's side
  const auto side = [](const vec3& p) { return p.x < 1.7f; };
  test::FakeSource source;
  source.free = [&](const vec3& a, const vec3& b) { return side(a) == side(b); };
  Pcg32 random(4);
  std::vector<vec3> places;
  for (int i = 0; i < 14; ++i) places.push_back(4.0f * random.uniform3());
  const IrradianceLookup lookup(test::varied_set(places, 3, light_at), source, by(WeightMethod::distance));
  std::vector<rays::SurfacePoint> at = points(60, 0, 4);
  // Sight begins a little off the surface
  std::erase_if(at, [](const auto& p) { return std::abs(p.position.x - 1.7f) < 0.05f; });
  expect_light(lookup, at, [&](const auto& p) {
    std::vector<vec3> seen;
    std::ranges::copy_if(places, std::back_inserter(seen),
                         [&](const vec3& q) { return side(q) == side(p.position); });
    return by_distance(seen, p, 8);
  });
}

TEST(LookupFields, FittedWeightsAreLinearOnTheFloorInEveryColour) {
  // Points 0.25 m apart; probe k's weight is linear in place. A fit of so dense points leaves 0.5 % of the
  // weights, whose lights differ by up to 6
  const std::vector<vec3> places{{0, 1, 0}, {4, 1, 0}, {0, 1, 4}};
  const auto weights = [](const vec3& p) {
    return vec3(0.9f - 0.2f * p.x - 0.1f * p.z, 0.05f + 0.15f * p.x, 0.05f + 0.1f * p.z);
  };
  FittedPoints fitted;
  for (int i = 0; i < 17 * 17; ++i) {
    const vec3 p = 0.25f * vec3(i % 17, 0, i / 17);
    fitted.points.push_back({p, {0, 1, 0}});
    PointWeights& entry = fitted.weights.emplace_back();
    for (int k = 0; k < 3; ++k) entry.add(k, weights(p)[k]);
  }
  ProbeSet set = test::varied_set(places, 4, light_at);
  set.fitted = fitted;
  const test::FakeSource source;
  const IrradianceLookup lookup(set, source, by(WeightMethod::fitted));
  Pcg32 random(5);
  for (int i = 0; i < 40; ++i) {
    const rays::SurfacePoint p{vec3(0.5f + 3 * random.uniform(), 0, 0.5f + 3 * random.uniform()), {0, 1, 0}};
    const vec3 w = weights(p.position);
    const VariedLight expected =
        w[0] * light_at(places[0]) + w[1] * light_at(places[1]) + w[2] * light_at(places[2]);
    expect_near(lookup.irradiance(p), expected.irradiance(p.normal), pi * 0.03f);
    const vec3 positive = glm::max(w, vec3(0)), one(1),
               v = positive * glm::dot(w, one) / glm::dot(positive, one);
    const VariedLight glossy =
        v[0] * light_at(places[0]) + v[1] * light_at(places[1]) + v[2] * light_at(places[2]);
    expect_near(lookup.glossy(p, {0.6f, 0.8f, 0}, 0.4f),
                glossy.glossy({0.6f, 0.8f, 0}, sh::glossy_band_scales(0.4f)), 0.03f);
  }
}

TEST(LookupFields, LightTakesItsProbesRadianceAlongTheWayToIt) {
  Pcg32 random(6);
  std::vector<vec3> places;
  for (int i = 0; i < 12; ++i) places.push_back(4.0f * random.uniform3());
  // What stands at z > 3 is hidden
  test::FakeSource source;
  source.free = [](const vec3&, const vec3& b) { return b.z <= 3; };
  const LightLookup lookup(test::varied_set(places, 4, light_at), source);
  int lit = 0;
  for (const rays::SurfacePoint& p : points(60, 0, 4)) {
    const vec3* chosen = nullptr;
    for (const vec3& q : places) {
      const vec3 d = q - p.position;
      if (glm::dot(d, p.normal) > 0 && q.z <= 3 &&
          (!chosen || glm::length(d) < glm::distance(*chosen, p.position)))
        chosen = &q;
    }
    if (!chosen) continue;
    ++lit;
    const vec3 w = glm::normalize(*chosen - p.position);
    expect_near(lookup.irradiance(p), pi * light_at(*chosen).radiance(w), pi * field_rounding);
    const vec3 r = glm::normalize(p.normal + vec3(0.3f, -0.2f, 0.4f));
    expect_near(lookup.glossy(p, r, 0.5f), light_at(*chosen).glossy(r, sh::glossy_band_scales(0.5f)),
                field_rounding);
  }
  EXPECT_GT(lit, 40);
}

TEST(LookupFields, EachLayerAndLightIsItsOwn) {
  const vec3 place(1, 2, 3);
  const VariedLight own = light_at(place), lamps = light_at({3, 0, 1}), others = light_at({0, 4, 2});
  ProbeSet set = test::varied_set(
      {place}, 4, [&](const vec3&) { return own; }, [&](const vec3&) { return lamps; });
  set.hierarchy.emplace();
  set.hierarchy->neighbor = {others.sh(4)};
  set.hierarchy->sum = {set.probes[0].self};
  set.hierarchy->sum[0] += others.sh(4);
  const test::FakeSource source;
  const auto expect = [&](std::optional<ProbeLayer> layer, ProbeLight light, const VariedLight& expected) {
    LookupParams params;
    params.layer = layer, params.light = light;
    expect_light(IrradianceLookup(set, source, params), points(10, 0, 4),
                 [&](const auto&) { return expected; });
  };
  expect(ProbeLayer::self, ProbeLight::reflected, own);
  expect(ProbeLayer::self, ProbeLight::all, own + lamps);
  expect(ProbeLayer::neighbor, ProbeLight::reflected, others);
  expect(ProbeLayer::sum, ProbeLight::reflected, own + others);
  expect(std::nullopt, ProbeLight::all, own + lamps + others);
}

TEST(LookupFields, BandsOverTheIrradiancesDegreeAreLeftToTheLobes) {
  const vec3 place(1, 2, 3);
  const test::FakeSource source;
  LookupParams params;
  params.irradiance_degree = 1;
  const IrradianceLookup lookup(test::varied_set({place}, 4, light_at), source, params);
  VariedLight first = light_at(place);
  const vec3 n = glm::normalize(vec3(1, 2, -1));
  expect_near(lookup.glossy({{0, 0, 0}, n}, n, 0), first.radiance(n), field_rounding);
  first.c = vec3(0);
  expect_near(lookup.irradiance({{0, 0, 0}, n}), first.irradiance(n), field_rounding);
}

}  // namespace
}  // namespace ssphh::probes
