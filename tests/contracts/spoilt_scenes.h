#pragma once
/// A small scene with one of everything, and what may be wrong with its indices.

#include <functional>
#include <string>
#include <vector>

#include <ssphh/scene/primitives.h>
#include <ssphh/scene/scene.h>

namespace ssphh::test {

/// A quad with texture and lamp, a camera and an SPHL at two nodes, one of them animated.
inline scene::Scene sound_scene() {
  scene::Scene scene;
  scene.name = "sound";
  scene.textures.push_back({});
  scene.textures[0].width = scene.textures[0].height = 1;
  scene.textures[0].rgba.assign(4, 128);
  scene.materials.push_back({});
  scene.materials[0].base_color_texture.texture = 0;
  scene.meshes.push_back(scene::make_quad(vec3(-1, 0, -1), vec3(0, 0, 2), vec3(2, 0, 0)));
  scene.meshes[0].material = 0;
  scene.nodes.resize(2);
  scene.nodes[1].parent = 0;
  scene.nodes[1].local.translation = vec3(0, 1, 0);
  scene.nodes[1].movable = true;
  scene.instances.emplace_back().mesh = 0;
  scene.instances[0].node = 0;
  scene.cameras.emplace_back().name = "front";
  scene.cameras[0].node = 1;
  scene.lights.emplace_back().name = "lamp";
  scene.lights[0].node = 1;
  scene.sphls.push_back({"probe", 1});
  scene.animations.push_back(
      {"swing", {{.node = 1, .times = {0, 1}, .values = {vec4(0, 1, 0, 0), vec4(0, 2, 0, 0)}}}});
  return scene;
}

struct SpoiltScene {
  std::string name;
  std::function<void(scene::Scene&)> spoil;
  std::vector<std::string> words;

  scene::Scene make() const {
    scene::Scene scene = sound_scene();
    spoil(scene);
    return scene;
  }
};

inline std::vector<SpoiltScene> spoilt_scenes() {
  using scene::Scene;
  return {
      {"OfAMeshThatIsNotThere", [](Scene& s) { s.instances[0].mesh = 9; }, {"instance 0", "mesh 9 of 1"}},
      {"OfMeshMinusOne", [](Scene& s) { s.instances[0].mesh = -1; }, {"instance 0", "mesh -1 of 1"}},
      {"OfAnInstanceAtNoNode", [](Scene& s) { s.instances[0].node = 2; }, {"instance 0", "node 2 of 2"}},
      {"OfAnInstanceOfNoMaterial",
       [](Scene& s) { s.instances[0].material = 1; },
       {"instance 0", "material 1 of 1"}},
      {"OfAMaterialThatIsNotThere",
       [](Scene& s) { s.meshes[0].material = 3; },
       {"mesh 0", "material 3 of 1"}},
      {"OfATriangleWithoutCorner",
       [](Scene& s) { s.meshes[0].triangles[1].y = 4; },
       {"mesh 0", "triangle 1", "vertex 4 of 4"}},
      {"OfTooFewNormals", [](Scene& s) { s.meshes[0].normals.pop_back(); }, {"mesh 0", "3 normals"}},
      {"OfATextureThatIsNotThere",
       [](Scene& s) { s.materials[0].normal_texture.texture = 1; },
       {"material 0", "texture 1 of 1"}},
      {"OfATextureWithoutTexels", [](Scene& s) { s.textures[0].rgba.clear(); }, {"texture 0", "0 bytes"}},
      {"OfAParentThatComesLater", [](Scene& s) { s.nodes[0].parent = 1; }, {"node 0", "parent 1"}},
      {"OfACameraAtNoNode", [](Scene& s) { s.cameras[0].node = 5; }, {"camera 0 \"front\"", "node 5"}},
      {"OfALightAtNoNode", [](Scene& s) { s.lights[0].node = -2; }, {"light 0 \"lamp\"", "node -2"}},
      {"OfAnSphlAtNoNode", [](Scene& s) { s.sphls[0].node = 2; }, {"SPHL 0 \"probe\"", "node 2"}},
      {"OfAKeyWithoutValue",
       [](Scene& s) { s.animations[0].channels[0].values.pop_back(); },
       {"animation 0 \"swing\"", "1 values for 2 keys"}},
      {"OfAnAnimationWithoutKeys",
       [](Scene& s) {
         s.animations[0].channels[0].values.clear();
         s.animations[0].channels[0].times.clear();
       },
       {"no keys"}},
      {"OfAnAnimatedNodeThatIsNotThere",
       [](Scene& s) { s.animations[0].channels[0].node = 2; },
       {"channel 0", "node 2 of 2"}},
  };
}

}  // namespace ssphh::test
