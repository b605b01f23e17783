/// SPHLs that shine: on a floor by closed forms, by path tracing and as transport sees it; with things within
/// their radius, and in time.

#include <gtest/gtest.h>

#include <ssphh/scene/query.h>
#include <ssphh/trace/transport_scene.h>

#include "hand_made.h"

namespace ssphh::trace {
namespace {

using test::add_floor;
using test::add_light;
using test::add_object;
using test::lambertian;

constexpr float height = 2, half_angle = 0.7f;

/// A beam straight down, whose frames are `frames` times as bright as each other, and a plate below the lamp.
scene::Scene lamp_above_floor(float radius, float plate_below) {
  scene::Scene s;
  add_floor(s, lambertian(vec3(0.5f)));
  scene::Light& lamp = add_light(s, scene::LightType::sphl, 10, {0, height, 0});
  lamp.color = {1, 0.5f, 0.25f}, lamp.radius = radius;
  const sh::IntensitySh beam = scene::lobe_emission(scene::Lobe::beam, {0, 0, -1}, half_angle);
  sh::IntensitySh bright = beam;
  bright *= vec3(3);
  lamp.emission = {{beam, bright}, 1, 0, false};
  add_object(
      s, scene::make_box({-0.1f, height - plate_below - 0.01f, -0.1f}, {0.1f, height - plate_below, 0.1f}),
      lambertian(vec3(0)));
  scene::validate(s);
  return s;
}

/// E at a point of the floor at time 0, without shadows.
vec3 closed_form(float aside) {
  const float kappa = std::log(2.0f) / (1 - std::cos(half_angle));
  const float d2 = height * height + aside * aside, cosine = height / std::sqrt(d2);
  return vec3(1, 0.5f, 0.25f) * 10.0f * std::exp(kappa * (cosine - 1)) * cosine / d2;
}

std::vector<rays::SurfacePoint> floor_points() {
  std::vector<rays::SurfacePoint> points;
  for (const float aside : {0.0f, 0.2f, 1.0f, 2.5f}) points.push_back({{aside, 0, 0}, {0, 1, 0}});
  return points;
}

// Degree 10 leaves out 1e-4 of the peak of this beam.
constexpr float least = 3e-4f * 10 / (height * height);

void expect_light(const scene::Scene& s, float time, const std::vector<vec3>& expected, const char* what) {
  const auto points = floor_points();
  const auto traced = PathTracer(s, time).surface_irradiance(points, {.max_depth = 1, .spp = 1}, {});
  const TransportScene source(s);
  const scene::LightingState state = rays::lighting_at(source, time);
  const auto direct = source.direct_light(
      state.lights, std::vector<mat4>(static_cast<std::size_t>(source.part_count()), mat4(1)), 0);
  std::vector<vec3> seen(points.size());
  direct->irradiance(0, points, seen);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(max_component(glm::abs(traced[i].direct - expected[i])), least)
        << what << ", traced, point " << i;
    EXPECT_LT(max_component(glm::abs(seen[i] - expected[i])), least) << what << ", transport, point " << i;
  }
}

std::vector<vec3> open_light(float factor = 1) {
  return {factor * closed_form(0), factor * closed_form(0.2f), factor * closed_form(1),
          factor * closed_form(2.5f)};
}

TEST(SphlLamp, WhatStandsWithinItsRadiusShadowsNothing) {
  expect_light(lamp_above_floor(0.5f, 0.3f), 0, open_light(), "plate within");
  // Of half a metre below, the plate hides the floor out to 0.4 m
  std::vector<vec3> shadowed = open_light();
  shadowed[0] = shadowed[1] = vec3(0);
  expect_light(lamp_above_floor(0.45f, 0.5f), 0, shadowed, "plate beyond");
}

TEST(SphlLamp, FollowsItsFramesInTime) {
  const scene::Scene s = lamp_above_floor(0.5f, 0.3f);
  expect_light(s, 0.25f, open_light(1.5f), "a quarter on the way");
  expect_light(s, 1, open_light(3), "last frame");
  expect_light(s, 7, open_light(3), "after it");
}

}  // namespace
}  // namespace ssphh::trace
