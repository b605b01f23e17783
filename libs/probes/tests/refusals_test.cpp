/// What entries of the module refuse, word by word; tests/contracts asks that nothing is left half done.

#include <gtest/gtest.h>

#include <ssphh/probes/lookup_weights.h>
#include <ssphh/probes/probe_set.h>

#include "error_message.h"

namespace ssphh::probes {
namespace {

using test::message_of;

constexpr float none = std::numeric_limits<float>::quiet_NaN();
constexpr float endless = std::numeric_limits<float>::infinity();

TEST(Refusals, OfLookups) {
  const SeesProbe sees = [](const vec3&, const vec3&) { return true; };
  const std::vector<vec3> one{vec3(0)};
  const auto said = [&](std::span<const vec3> at, const SeesProbe& see, const WeightParams& params = {}) {
    return message_of([&] { make_weights(at, see, params, nullptr); });
  };
  EXPECT_EQ(said({}, sees), "probe lookup: the probe set is empty (bake a scene with SPHLs)");
  EXPECT_EQ(said(std::vector<vec3>{vec3(0), vec3(0, none, 0)}, sees),
            "probe lookup: a probe's position is not finite");
  EXPECT_EQ(said(one, nullptr), "probe lookup: nothing tells what sees the probes");
  const std::string lengths = "probe lookup: spacing and normal offset must be lengths";
  for (const float bad : {-0.1f, none, endless}) {
    EXPECT_EQ(said(one, sees, {.method = {}, .spacing = bad}), lengths);
    EXPECT_EQ(said(one, sees, {.method = {}, .normal_offset = bad}), lengths);
  }
  EXPECT_EQ(said(one, sees, {.method = WeightMethod::fitted}),
            "probe lookup: there are no fitted weights (fit some, or choose others)");
  EXPECT_EQ(said(one, sees), "no error");
  PointWeights full;
  for (int i = 0; i < 16; ++i) full.add(i, 1);
  EXPECT_EQ(message_of([&] { full.add(16, 1); }), "list of weights: it is full");
}

TEST(Refusals, OfLightOfMoreGroupsThanTheSetHas) {
  ProbeSet set;
  set.degree = 1;
  set.probes.resize(2);
  set.light_groups.resize(2);
  set.probes[1].groups.resize(2);
  EXPECT_EQ(message_of([&] { merge_groups(set); }), "no error");
  set.probes[1].groups.resize(5);
  EXPECT_EQ(message_of([&] { merge_groups(set); }), "probe 1: has the light of 5 groups; the set has 2");
}

}  // namespace
}  // namespace ssphh::probes
