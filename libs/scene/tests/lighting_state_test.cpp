/// What lights a scene, as one value: what it is at first, and what is refused.

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/query.h>

#include "error_message.h"

namespace ssphh::scene {
namespace {

using test::message_of;

TEST(LightingState, IsAtFirstThatOfTheSceneAtItsTime) {
  Scene scene = make_builtin("gallery1");
  scene.lights.emplace_back();
  scene.lights.back().color = {1, 0.5f, 0.25f}, scene.lights.back().intensity = 7;
  scene.lights.back().node = static_cast<int>(scene.nodes.size());
  scene.nodes.emplace_back().local.translation = {1, 2, 3};
  scene.animations.push_back({"swing",
                              {{scene.lights.back().node,
                                AnimationPath::translation,
                                Interpolation::linear,
                                {0, 2},
                                {vec4(1, 2, 3, 0), vec4(3, 2, 3, 0)}}}});
  const LightingState state = lighting_at(scene, 0.5f);
  EXPECT_EQ(state.time, 0.5f);
  ASSERT_EQ(state.lights.size(), scene.lights.size());
  EXPECT_EQ(vec3(state.lights.back().world[3]), vec3(1.5f, 2, 3));
  EXPECT_EQ(state.lights.back().color, vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(state.lights.back().intensity, 7);
  EXPECT_EQ(state.group_scales, std::vector<vec3>(light_groups(scene).size(), vec3(1)));
  EXPECT_EQ(state.environment_rotation, 0);
  EXPECT_TRUE(state.emission.empty());
  EXPECT_EQ(lighting_at(scene).time, 0);
}

TEST(LightingState, WhatCannotBeIsRefusedByItsName) {
  LightingState sound;
  sound.lights.resize(2), sound.group_scales.resize(1, vec3(1));
  const auto said = [&](const std::function<void(LightingState&)>& spoil) {
    LightingState state = sound;
    spoil(state);
    return message_of([&] { check_lighting(state, {2, 1, 3}); });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(said([](auto&) {}), "no error");
  EXPECT_EQ(said([](auto& s) { s.lights.pop_back(); }),
            "lighting: it has 1 lights and 1 groups, but the scene has 2 and 1 (start from "
            "scene::lighting_at())");
  EXPECT_EQ(said([](auto& s) { s.group_scales.clear(); }),
            "lighting: it has 2 lights and 0 groups, but the scene has 2 and 1 (start from "
            "scene::lighting_at())");
  const std::string of_a_light =
      "light 1: its place, colour and intensity must be finite, the last not negative";
  EXPECT_EQ(said([&](auto& s) { s.lights[1].intensity = nan; }), of_a_light);
  EXPECT_EQ(said([](auto& s) { s.lights[1].intensity = -0.5f; }), of_a_light);
  EXPECT_EQ(said([&](auto& s) { s.lights[1].color.z = nan; }), of_a_light);
  for (int column = 0; column < 4; ++column)
    EXPECT_EQ(said([&](auto& s) { s.lights[1].world[column].y = nan; }), of_a_light) << column;
  EXPECT_EQ(said([](auto& s) { s.lights[1].intensity = 0; }), "no error") << "off";
  const std::string of_a_group = "light group 0: its factor must be finite and not negative";
  EXPECT_EQ(said([](auto& s) { s.group_scales[0].z = -0.5f; }), of_a_group);
  EXPECT_EQ(said([&](auto& s) { s.group_scales[0].y = nan; }), of_a_group);
  EXPECT_EQ(said([](auto& s) { s.group_scales[0] = vec3(0); }), "no error") << "dark";
  EXPECT_EQ(said([&](auto& s) { s.time = nan; }), "time: it must be a finite number of seconds");
  EXPECT_EQ(said([&](auto& s) { s.environment_rotation = nan; }),
            "environment: its rotation must be a finite angle");
  const auto emits = [&](std::vector<SphlEmission> emission) {
    return said([&](auto& s) { s.emission = emission; });
  };
  EXPECT_EQ(emits({{2, {}}, {0, sh::RadianceSh(10)}}), "no error");
  EXPECT_EQ(emits({{3, {}}}), "emission of probe 3: there are 3 probes");
  EXPECT_EQ(emits({{-1, {}}}), "emission of probe -1: there are 3 probes");
  EXPECT_EQ(emits({{0, {}}, {2, {}}, {0, {}}}), "emission of probe 0: it is given twice");
  sh::RadianceSh odd, broken(1);
  odd.values.resize(5);
  broken[3].y = nan;
  EXPECT_EQ(emits({{0, odd}}), "SPHL emission: its coefficients are not those of a degree");
  EXPECT_EQ(emits({{0, broken}}), "SPHL emission: it is not finite");
}

}  // namespace
}  // namespace ssphh::scene
