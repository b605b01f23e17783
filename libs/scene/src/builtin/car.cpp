#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {
namespace {

/// Drives along its −z. Its origin is on the ground below its middle.
int add_car(Builder& b) {
  const int paint = b.glossy("paint", {0.5f, 0.05f, 0.04f}, 0.35f), rubber = b.matte("rubber", vec3(0.04f));
  const int windows = b.glossy("windows", vec3(0.02f), 0.1f), bumper = b.glossy("bumper", vec3(0.6f), 0.4f);
  const int car = b.node("car", at({1.2f, 0, 6.5f}));
  b.add_at(car, "body", make_box({-0.85f, 0.3f, -2}, {0.85f, 0.85f, 2}), paint);
  b.add_at(car, "cabin", make_box({-0.7f, 0.85f, -0.9f}, {0.7f, 1.35f, 1.3f}), windows);
  b.add_at(car, "front bumper", make_box({-0.8f, 0.32f, -2.08f}, {0.8f, 0.48f, -2.001f}), bumper);
  const Mesh wheel = transformed(make_cylinder(0.32f, 0.2f, 32), at(vec3(0), 90, {0, 0, 1}).matrix());
  for (const float x : {-0.75f, 0.95f}) {
    for (const float z : {-1.3f, 1.3f})
      b.add_at(car, "wheel", transformed(wheel, at({x, 0.33f, z}).matrix()), rubber);
  }
  b.stand_on(car);
  for (const float x : {-0.6f, 0.6f}) {
    const std::string side = x < 0 ? "left" : "right";
    b.spot_light("head " + side, {x, 0.66f, -2.05f}, {x, 0.4f, -12}, {1, 0.95f, 0.85f}, 60, 14, 38, "head");
    b.add_emitter("tail " + side, "tail", make_quad({x - 0.12f, 0.62f, 2.002f}, {0.24f, 0, 0}, {0, 0.1f, 0}),
                  {60, 3, 1});
  }
  b.stand_on(-1);
  return car;
}

}  // namespace

Scene make_car() {
  Builder b("car");
  const int concrete = b.matte("concrete", vec3(0.55f)), floor = b.matte("floor", vec3(0.3f));
  const int yellow = b.matte("marks", {0.8f, 0.65f, 0.1f}), green = b.matte("door", {0.2f, 0.5f, 0.3f});
  b.add("garage", flipped(make_box({-4, 0, -10}, {4, 2.8f, 10})), concrete);
  b.add("asphalt", make_quad({-3.99f, 0.005f, 9.99f}, {7.98f, 0, 0}, {0, 0, -19.98f}), floor);
  for (const float z : {-6.0f, 0.0f, 6.0f}) {
    b.add("pillar", make_box({-1.4f, 0.005f, z - 0.2f}, {-1.0f, 2.799f, z + 0.2f}), concrete);
    b.add("mark", make_box({-1.41f, 0.8f, z - 0.21f}, {-0.99f, 1.1f, z + 0.21f}), yellow);
  }
  b.add("gate", make_box({0.2f, 0.005f, -9.98f}, {2.6f, 2.2f, -9.9f}), green);
  const int car = add_car(b);
  b.scene().animations.push_back({"drive",
                                  {{.node = car,
                                    .path = AnimationPath::translation,
                                    .interpolation = Interpolation::linear,
                                    .times = {0, 4},
                                    .values = {{1.2f, 0, 6.5f, 0}, {1.2f, 0, -5.5f, 0}}}}});
  b.camera("main", {-3.3f, 1.7f, 8.8f}, {1, 0.6f, -1}, 60);
  b.camera("gate", {-3.2f, 1.5f, -8.8f}, {1.2f, 0.7f, 1}, 60);
  b.sphl("north", {-2.6f, 1.5f, 7});
  b.sphl("aisle", {1.2f, 2.1f, 3});
  b.sphl("middle", {-2.6f, 1.5f, 0});
  b.sphl("south", {-2.6f, 1.5f, -7});
  b.sphl("gate", {1.2f, 1.9f, -8.6f});
  return b.finish();
}

}  // namespace ssphh::scene
