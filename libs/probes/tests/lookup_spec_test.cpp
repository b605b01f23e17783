/// What a choice of people means for a set (LookupSpec).

#include <gtest/gtest.h>

#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>

#include "fake_source.h"
#include "random_set.h"

namespace ssphh::probes {
namespace {

ProbeSet some_set(bool hierarchy) {
  ProbeSet set = test::random_set(3, 5, 2);
  set.hierarchy.reset();
  merge_groups(set);
  if (hierarchy) hier(set, {});
  return set;
}

TEST(LookupSpec, BeginsAsTheToolsDefaults) {
  const LookupSpec spec;
  EXPECT_EQ(spec.method, LookupMethod::irradiance);
  EXPECT_FALSE(spec.weights.has_value());
  EXPECT_EQ(spec.layer, ProbeLayer::sum);
}

TEST(LookupSpec, TakesTheProbesOwnLightWhereThereIsNoHierarchy) {
  for (const ProbeLayer layer : {ProbeLayer::self, ProbeLayer::neighbor, ProbeLayer::sum}) {
    EXPECT_EQ(lookup_params({.layer = layer}, some_set(false)).layer, ProbeLayer::self);
    EXPECT_EQ(lookup_params({.layer = layer}, some_set(true)).layer, layer);
  }
}

TEST(LookupSpec, HandsItsWeightsOn) {
  EXPECT_EQ(lookup_params({}, some_set(false)).weights.method, std::nullopt);
  EXPECT_EQ(lookup_params({.weights = WeightMethod::mls}, some_set(false)).weights.method, WeightMethod::mls);
}

TEST(LookupSpec, MakesTheLookupThatItNames) {
  const test::FakeSource source;
  for (const bool hierarchy : {false, true}) {
    const ProbeSet set = some_set(hierarchy);
    for (const ProbeLayer layer : {ProbeLayer::self, ProbeLayer::sum}) {
      LookupParams params;
      if (layer == ProbeLayer::self) params.layer = layer;
      params.weights.method = WeightMethod::distance;
      const LightLookup light(set, source, params);
      const IrradianceLookup irradiance(set, source, params);
      const auto by_light = make_lookup({LookupMethod::light, {}, layer}, set, source);
      const auto by_irradiance =
          make_lookup({LookupMethod::irradiance, WeightMethod::distance, layer}, set, source);
      for (int i = 0; i < 20; ++i) {
        const rays::SurfacePoint at{vec3(0.4f * static_cast<float>(i)), spherical_fibonacci(i, 20)};
        EXPECT_EQ(by_light->irradiance(at), light.irradiance(at));
        EXPECT_EQ(by_irradiance->irradiance(at), irradiance.irradiance(at));
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::probes
