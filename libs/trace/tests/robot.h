#pragma once
/// A scene in which parts hang on parts.

#include "hand_made.h"

namespace ssphh::test {

/// A chain of animated nodes: base (moves), arm below it (turns and grows), hand below a still node on the
/// arm, and an animated node that carries only a lamp.
inline scene::Scene robot() {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.5f)));
  const int base = add_node(scene, "base", vec3(0.2f, -0.5f, 0));
  add_object(scene, scene::make_box(vec3(-0.2f), vec3(0.2f)), lambertian(vec3(0.6f)), "", base);
  const int arm = add_node(scene, "arm", vec3(0, 0.3f, 0));
  scene.nodes.back().parent = base;
  scene.nodes.back().local.scale = vec3(1, 2, 1);
  const int wrist = add_node(scene, "wrist", vec3(0, 0.2f, 0.1f), glm::normalize(quat(1, 0.2f, 0, 0.4f)));
  scene.nodes.back().parent = arm;
  add_object(scene, scene::make_box(vec3(-0.05f), vec3(0.05f)), lambertian(vec3(0.7f), vec3(2)), "hand",
             wrist);
  const int swing = add_node(scene, "swing", vec3(0, 0.9f, 0));
  add_light(scene, scene::LightType::point, 1, vec3(0, -0.1f, 0));
  scene.nodes.back().parent = swing;
  scene::Animation animation;
  using scene::AnimationPath, scene::Interpolation;
  animation.channels.push_back({base,
                                AnimationPath::translation,
                                Interpolation::linear,
                                {0, 1},
                                {{0.2f, -0.5f, 0, 0}, {-0.3f, -0.4f, 0.2f, 0}}});
  animation.channels.push_back(
      {arm, AnimationPath::rotation, Interpolation::linear, {0, 1}, {{0, 0, 0, 1}, {0.3f, 0, 0, 0.954f}}});
  animation.channels.push_back(
      {arm, AnimationPath::scale, Interpolation::linear, {0, 1}, {{1, 2, 1, 0}, {1.5f, 1, 1, 0}}});
  animation.channels.push_back({swing,
                                AnimationPath::translation,
                                Interpolation::linear,
                                {0, 1},
                                {{0, 0.9f, 0, 0}, {0.5f, 0.9f, 0, 0}}});
  scene.animations.push_back(animation);
  return scene;
}

}  // namespace ssphh::test
