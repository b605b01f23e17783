#pragma once
/// One sound scene for what keeps a reference to it.

#include <memory>

#include <ssphh/trace/scene_geometry.h>

#include "spoilt_scenes.h"

namespace ssphh::test {

inline const scene::Scene& kept_scene() {
  static const scene::Scene scene = sound_scene();
  return scene;
}

inline trace::SharedGeometry kept_geometry() {
  static const auto geometry = std::make_shared<const trace::SceneGeometry>(kept_scene());
  return geometry;
}

}  // namespace ssphh::test
