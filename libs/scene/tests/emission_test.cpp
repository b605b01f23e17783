/// What SPHLs send out: frames in time, lobes with names, and what is refused.

#include <limits>

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/with_lighting.h>

#include "error_message.h"

namespace ssphh::scene {
namespace {

using test::message_of;

sh::IntensitySh uniform(const vec3& value) {
  sh::IntensitySh frame(0);
  frame[0] = value;
  return frame;
}

Emission sequence(bool repeat) {
  return {{uniform({0, 0, 1}), uniform({4, 0, 1}), uniform({8, 8, 1})}, 2, 1, repeat};
}

TEST(Emission, IsLinearBetweenFramesAndHoldsItsEnds) {
  const Emission once = sequence(false);
  const auto at = [&](float time) { return emission_at(once, time)[0]; };
  EXPECT_EQ(at(-5), vec3(0, 0, 1));
  EXPECT_EQ(at(1), vec3(0, 0, 1));
  EXPECT_EQ(at(1.25f), vec3(2, 0, 1));
  EXPECT_EQ(at(1.5f), vec3(4, 0, 1));
  EXPECT_EQ(at(1.875f), vec3(7, 6, 1));
  EXPECT_EQ(at(2), vec3(8, 8, 1));
  EXPECT_EQ(at(99), vec3(8, 8, 1));
  EXPECT_EQ(emission_end(once), 2);
}

TEST(Emission, ThatRepeatsGoesFromTheLastFrameToTheFirst) {
  const Emission again = sequence(true);
  const auto at = [&](float time) { return emission_at(again, time)[0]; };
  EXPECT_EQ(at(2.25f), vec3(4, 4, 1));
  for (const float time : {1.0f, 1.25f, 1.5f, 2.25f}) {
    EXPECT_EQ(at(time + 1.5f), at(time)) << time;
    EXPECT_EQ(at(time - 3), at(time)) << time;
  }
  EXPECT_EQ(emission_end(again), 2.5f);
  for (const float time : {1e9f, -1e9f, 3e38f}) EXPECT_TRUE(is_finite(at(time))) << time;
}

TEST(Emission, IsPartOfHowLongASceneLasts) {
  Scene scene;
  scene.nodes.resize(1);
  scene.lights.resize(1);
  Light& light = scene.lights[0];
  light.node = 0, light.type = LightType::sphl, light.radius = 0.1f;
  light.emission = sequence(true);
  EXPECT_EQ(animation_duration(scene), 2.5f);
  EXPECT_EQ(lighting_at(scene, 1.25f).lights[0].emission[0], vec3(2, 0, 1));
}

TEST(Emission, UnderALightingIsThatOfTheState) {
  Scene scene;
  scene.nodes.resize(1);
  scene.lights.resize(1);
  Light& light = scene.lights[0];
  light.node = 0, light.type = LightType::sphl, light.radius = 0.1f;
  light.emission = sequence(true);
  LightingState state = lighting_at(scene, 1.25f);
  EXPECT_EQ(with_lighting(scene, state).lights[0].emission, light.emission) << "to the bit";
  state.lights[0].emission = uniform(vec3(5));
  const Scene changed = with_lighting(scene, state);
  EXPECT_EQ(emission_at(changed.lights[0].emission, 1.25f)[0], vec3(5));
  state.lights[0].emission = {};
  EXPECT_EQ(with_lighting(scene, state).lights[0].intensity, 0) << "dark";
}

TEST(Emission, IsNotNegativeAndHasItsOwnColours) {
  sh::IntensitySh emission(1);
  emission[0] = vec3(1) / 0.28209479f;
  emission[2] = vec3(2, 0, -2) / 0.48860251f;  // 1 ± 2 z
  EXPECT_LT(glm::distance(eval_intensity(emission, {0, 0, 1}), vec3(3, 1, 0)), 1e-5f);
  EXPECT_LT(glm::distance(eval_intensity(emission, {0, 0, -1}), vec3(0, 1, 3)), 1e-5f);
  EXPECT_LT(glm::distance(mean_intensity(emission), vec3(1)), 1e-6f);
}

TEST(Lobe, HasItsShape) {
  const vec3 axis = glm::normalize(vec3(1, -2, 0.5f));
  const Frame frame = Frame::around(axis);
  const auto at = [&](const sh::IntensitySh& lobe, float angle) {
    return eval_intensity(lobe, std::cos(angle) * axis + std::sin(angle) * frame.x);
  };
  const sh::IntensitySh even = lobe_emission(Lobe::uniform, axis, 0);
  EXPECT_EQ(even.degree(), 0);
  for (const float angle : {0.0f, 1.0f, 3.0f}) EXPECT_NEAR(at(even, angle).y, 1, 1e-6f);
  for (const float half : {0.5f, 1.0f, 2.0f}) {
    const sh::IntensitySh beam = lobe_emission(Lobe::beam, axis, half);
    // exp(−l (l + 1) / 2κ) of the first band that is missing: 1e-5 at half a radian
    EXPECT_NEAR(at(beam, 0).x, 1, 2e-4f) << half;
    EXPECT_NEAR(at(beam, half).z, 0.5f, 2e-4f) << half;
  }
  // The narrowest has lost some of its peak to the bands above 10
  const sh::IntensitySh narrow = lobe_emission(Lobe::beam, axis, narrowest_beam);
  EXPECT_NEAR(at(narrow, 0).x, 1, 0.2f);
  EXPECT_NEAR(at(narrow, narrowest_beam).x, 0.5f, 0.1f);
  const sh::IntensitySh cosine = lobe_emission(Lobe::cosine, axis, 0);
  for (const float angle : {0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 3.0f})
    EXPECT_NEAR(at(cosine, angle).x, std::max(std::cos(angle), 0.0f), 0.015f) << angle;
}

TEST(Lobe, RefusesWhatCannotBeShown) {
  EXPECT_EQ(
      message_of([] {
        lobe_emission(Lobe::beam, {0, 0, 1}, 0.2f);
      }),
      "lobe: a beam of half angle 11.5° (15° to 180° can be shown by spherical harmonics of degree 10)");
  EXPECT_EQ(message_of([] {
              lobe_emission(Lobe::cosine, {0, 0, 2}, 0);
            }),
            "lobe: its axis must be a unit vector");
}

TEST(Emission, WhatCannotBeIsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto said = [](const Emission& emission) {
    return message_of([&] { check_emission(emission, "lamp"); });
  };
  EXPECT_EQ(said(sequence(true)), "no error");
  EXPECT_EQ(said({}), "lamp: its emission has no frame");
  Emission odd = sequence(false);
  odd.frames[2] = sh::IntensitySh(1);
  const std::string of_degrees = " (every frame has (degree + 1)² of them, of one degree from 0 to 10)";
  EXPECT_EQ(said(odd), "lamp: frame 2 of its emission has 4 coefficients" + of_degrees);
  odd.frames = {sh::IntensitySh(1)};
  odd.frames[0].values.pop_back();
  EXPECT_EQ(said(odd), "lamp: its emission has 3 coefficients" + of_degrees);
  odd.frames[0].values.assign(144, vec3(0));
  EXPECT_EQ(said(odd), "lamp: its emission has 144 coefficients" + of_degrees);
  Emission broken = sequence(false);
  broken.frames[1][0].y = nan;
  EXPECT_EQ(said(broken), "lamp: frame 1 of its emission is not finite");
  Emission still = sequence(false);
  still.rate = 0;
  EXPECT_EQ(said(still), "lamp: its emission has 3 frames at 0 per second from 1 s");
  still = sequence(false), still.start = nan;
  EXPECT_EQ(said(still), "lamp: its emission has 3 frames at 2 per second from nan s");
  Scene scene;
  scene.nodes.resize(1);
  scene.lights.resize(1);
  scene.lights[0].node = 0, scene.lights[0].name = "fire", scene.lights[0].type = LightType::sphl;
  scene.lights[0].emission = sequence(false);
  EXPECT_EQ(message_of([&] { validate(scene); }),
            "light 0 \"fire\": SPHL of radius 0 m (give it a radius above 0)");
  scene.lights[0].radius = 1;
  EXPECT_EQ(message_of([&] { validate(scene); }), "no error");
  scene.lights[0].emission.frames.clear();
  EXPECT_EQ(message_of([&] { validate(scene); }), "light 0 \"fire\": its emission has no frame");
}

}  // namespace
}  // namespace ssphh::scene
