#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

constexpr float rounding = 1e-6f;  // of a few float operations on numbers near 1

Scene animated(AnimationPath path, Interpolation interpolation, std::vector<float> times,
               std::vector<vec4> values) {
  Scene scene;
  scene.nodes.resize(1);
  scene.animations.resize(1);
  scene.animations[0].channels.push_back({0, path, interpolation, std::move(times), std::move(values)});
  return scene;
}

vec3 translation(const Scene& scene, float time) {
  return vec3(world_matrices(scene, time)[0][3]);
}

void expect_near(const vec3& a, const vec3& b, float tolerance = rounding) {
  EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Transform, ScalesThenRotatesThenTranslates) {
  Transform t;
  t.translation = {1, 2, 3};
  t.rotation = glm::angleAxis(pi / 2, vec3(0, 1, 0));
  t.scale = {2, 3, 4};
  expect_near(vec3(t.matrix() * vec4(1, 1, 1, 1)), {1 + 4, 2 + 3, 3 - 2});
}

TEST(Pose, ChildrenFollowTheirParents) {
  Scene scene;
  scene.nodes.resize(3);
  scene.nodes[0].local.translation = {1, 0, 0};
  scene.nodes[0].local.rotation = glm::angleAxis(pi / 2, vec3(0, 1, 0));
  scene.nodes[1].parent = 0;
  scene.nodes[1].matrix = mat4(2);
  (*scene.nodes[1].matrix)[3] = vec4(0, 0, 1, 1);
  scene.nodes[1].local.translation = {9, 9, 9};  // the matrix replaces it
  scene.nodes[2].parent = 1;
  scene.nodes[2].local.translation = {0, 1, 0};
  // (0,1,0) → doubled and moved (0,2,1) → z turns to x: (1,2,0) → moved (2,2,0).
  expect_near(vec3(world_matrices(scene)[2][3]), {2, 2, 0});
}

TEST(Animation, StepHoldsLinearMixesAndBothClampOutsideOfTheKeys) {
  const std::vector<vec4> values{{0, 0, 0, 0}, {2, 4, 6, 0}, {0, 0, 8, 0}};
  const Scene step = animated(AnimationPath::translation, Interpolation::step, {1, 2, 4}, values);
  expect_near(translation(step, 0), {0, 0, 0});
  expect_near(translation(step, 1.99f), {0, 0, 0});
  expect_near(translation(step, 2), {2, 4, 6});
  expect_near(translation(step, 3.9f), {2, 4, 6});
  expect_near(translation(step, 9), {0, 0, 8});
  const Scene linear = animated(AnimationPath::translation, Interpolation::linear, {1, 2, 4}, values);
  expect_near(translation(linear, -1), {0, 0, 0});
  expect_near(translation(linear, 1.25f), {0.5f, 1, 1.5f});
  expect_near(translation(linear, 3), {1, 2, 7});
  expect_near(translation(linear, 9), {0, 0, 8});
  EXPECT_EQ(animation_duration(linear), 4);
}

TEST(Animation, ScaleReplacesTheNodesScale) {
  Scene scene = animated(AnimationPath::scale, Interpolation::linear, {0, 1}, {{1, 1, 1, 0}, {3, 5, 7, 0}});
  scene.nodes[0].local.scale = vec3(100);
  const mat4 m = world_matrices(scene, 0.5f)[0];
  expect_near({m[0][0], m[1][1], m[2][2]}, {2, 3, 4});
}

TEST(Animation, RotationTurnsAtConstantSpeedTheShortWay) {
  const quat end = glm::angleAxis(glm::radians(100.0f), vec3(0, 1, 0));
  for (const float sign : {1.0f, -1.0f}) {  // q and −q are the same rotation
    const Scene scene = animated(AnimationPath::rotation, Interpolation::linear, {0, 1},
                                 {{0, 0, 0, 1}, sign * vec4(end.x, end.y, end.z, end.w)});
    for (const float time : {0.0f, 0.1f, 0.25f, 0.7f, 1.0f}) {
      const float angle = glm::radians(100.0f) * time;
      expect_near(vec3(world_matrices(scene, time)[0] * vec4(0, 0, 1, 0)),
                  {std::sin(angle), 0, std::cos(angle)});
    }
  }
}

/// A cubic spline with the right tangents reproduces a cubic polynomial: p(t) = t³ − 2t² + 3, p′ = 3t² − 4t.
TEST(Animation, CubicSplineReproducesACubic) {
  const auto p = [](float t) { return t * t * t - 2 * t * t + 3; };
  const auto slope = [](float t) { return 3 * t * t - 4 * t; };
  std::vector<vec4> values;
  const std::vector<float> times{0, 0.5f, 2};
  for (const float t : times) values.insert(values.end(), {vec4(slope(t)), vec4(p(t)), vec4(slope(t))});
  const Scene scene = animated(AnimationPath::translation, Interpolation::cubic_spline, times, values);
  for (int i = 0; i <= 20; ++i) {
    const float t = 0.1f * static_cast<float>(i);
    expect_near(translation(scene, t), vec3(p(t)), 5e-6f);  // rounding of values near 3 times √3
  }
  expect_near(translation(scene, 5), vec3(p(2)));
}

TEST(Animation, CubicRotationIsNormalised) {
  const std::vector<vec4> values{{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0},
                                 {0, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}};
  const Scene scene = animated(AnimationPath::rotation, Interpolation::cubic_spline, {0, 1}, values);
  const mat4 m = world_matrices(scene, 0.5f)[0];
  EXPECT_NEAR(glm::determinant(mat3(m)), 1, rounding);
  expect_near(vec3(m * vec4(0, 0, 1, 0)), {1, 0, 0});  // half of the turn by 180°
}

TEST(Animation, MarksTheAnimatedNodeAndAllBelowItAsMovable) {
  Scene scene = animated(AnimationPath::translation, Interpolation::step, {0}, {vec4(0)});
  scene.nodes.resize(4);
  scene.nodes[1].parent = 0;
  scene.nodes[2].parent = 1;
  scene.nodes[3].movable = true;  // wrongly
  mark_movable(scene);
  EXPECT_TRUE(scene.nodes[0].movable && scene.nodes[1].movable && scene.nodes[2].movable);
  EXPECT_FALSE(scene.nodes[3].movable);
}

}  // namespace
}  // namespace ssphh::scene
