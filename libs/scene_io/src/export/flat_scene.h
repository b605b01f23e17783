#pragma once
/// A scene at one time, as other renderers take it: triangles and lights in world space, no hierarchy.

#include <string>
#include <vector>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// One instance's triangles in world space, wound counter-clockwise seen from the front also where the node
/// mirrors. Normals that point to the back are turned around, as shading does.
struct FlatMesh {
  std::string name;
  int material;      ///< −1: the default Material{}
  scene::Mesh mesh;  ///< tangents are left out
};

struct FlatLight {
  const scene::Light* light;
  mat4 world;
  vec3 position;
  vec3 direction;  ///< the way the light goes, unit
  /// Colour times intensity, in units as scene::Light; of an SPHL what a point light has that gives as much
  /// light.
  vec3 strength;
};

struct FlatScene {
  std::vector<FlatMesh> meshes;
  std::vector<FlatLight> lights;
};

/// `scene` must outlive the result. Instances without triangles are left out.
FlatScene flatten(const scene::Scene& scene, float time);

/// The material that a flat mesh is drawn with.
const scene::Material& material_of(const scene::Scene& scene, const FlatMesh& mesh);

}  // namespace ssphh::scene_io
