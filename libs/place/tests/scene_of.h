#pragma once

#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::place {

/// The meshes as they are, all at the origin.
inline scene::Scene scene_of(std::vector<scene::Mesh> meshes) {
  scene::Scene scene;
  scene.name = "test";
  scene.nodes.emplace_back();
  for (scene::Mesh& mesh : meshes) {
    scene.instances.push_back({static_cast<int>(scene.meshes.size()), 0, -1, {}});
    scene.meshes.push_back(std::move(mesh));
  }
  scene::validate(scene);
  return scene;
}

}  // namespace ssphh::place
