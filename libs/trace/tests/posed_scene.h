#pragma once

#include "posed_geometry.h"

namespace ssphh::test {

struct OwnGeometry {
  trace::ShadedGeometry shaded;
};

/// A scene's geometry at a time, ready for rays.
struct PosedScene : private OwnGeometry, trace::PosedGeometry {
  explicit PosedScene(const scene::Scene& scene, float time = 0,
                      std::uint64_t flatten_limit = trace::SceneGeometry::default_flatten_limit)
      : OwnGeometry{{std::make_shared<const trace::SceneGeometry>(scene, flatten_limit), scene}},
        trace::PosedGeometry(shaded, shaded.layout().poses(scene, time)) {}
};

/// The scene as it stands at `time`, with nothing that could move: every node under none.
inline scene::Scene frozen(scene::Scene scene, float time) {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  scene.animations.clear();
  for (std::size_t i = 0; i < world.size(); ++i) scene.nodes[i].parent = -1, scene.nodes[i].matrix = world[i];
  return scene;
}

}  // namespace ssphh::test
