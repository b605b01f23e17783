#pragma once

#include <ssphh/scene/query.h>

namespace ssphh::test {

/// The same scene turned about the origin as a whole, animations, lights and SPHLs included.
inline scene::Scene turned(scene::Scene scene, const quat& rotation) {
  scene::Node root;
  root.name = "turned";
  root.local.rotation = rotation;
  for (scene::Node& node : scene.nodes) ++node.parent;
  scene.nodes.insert(scene.nodes.begin(), root);
  for (scene::Instance& instance : scene.instances) {
    if (instance.light_group.empty()) instance.light_group = scene::light_group(scene, instance);
    ++instance.node;
  }
  for (scene::Camera& camera : scene.cameras) ++camera.node;
  for (scene::Light& light : scene.lights) ++light.node;
  for (scene::Sphl& sphl : scene.sphls) ++sphl.node;
  for (scene::Animation& animation : scene.animations) {
    for (scene::AnimationChannel& channel : animation.channels) ++channel.node;
  }
  return scene;
}

}  // namespace ssphh::test
