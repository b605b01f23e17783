#pragma once

#include <vector>

#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>

namespace ssphh::study {

/// Boxes given by their corners. The last one moves along x within a second if `moving`.
inline scene::Scene boxes(const std::vector<scene::Bounds>& list, bool moving = false) {
  scene::Scene scene;
  scene.materials.emplace_back();
  for (const scene::Bounds& box : list) {
    scene.meshes.push_back(scene::make_box(box.min, box.max));
    scene.meshes.back().material = 0;
    scene::Node node;
    scene.nodes.push_back(node);
    const int index = static_cast<int>(scene.nodes.size()) - 1;
    scene.instances.push_back({index, index, -1, ""});
  }
  if (moving) {
    scene::AnimationChannel channel;
    channel.node = static_cast<int>(scene.nodes.size()) - 1;
    channel.path = scene::AnimationPath::translation;
    channel.times = {0, 1};
    channel.values = {{0, 0, 0, 0}, {2, 0, 0, 0}};
    scene.animations.push_back({"move", {channel}});
  }
  scene::validate(scene);
  return scene;
}

}  // namespace ssphh::study
