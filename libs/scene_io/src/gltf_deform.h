#pragma once
/// What bends meshes: morph targets and the joints of skins.

#include <optional>
#include <vector>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Of one mesh; arrays are empty or as long as its positions.
struct MeshShape {
  struct Target {
    std::vector<vec3> positions, normals, tangents;  ///< differences for a weight of 1
  };
  struct Influences {
    std::vector<vec4> joints, weights;  ///< four of a vertex
  };
  std::vector<Target> targets;
  std::vector<Influences> influences;

  bool empty() const { return targets.empty() && influences.empty(); }
};

/// Adds the targets' differences, each times its weight.
void blend(scene::Mesh& mesh, const std::vector<MeshShape::Target>& targets,
           const std::vector<float>& weights);

/// Moves each vertex by the mean of its joints' matrices, by their weights; one without weights by its first
/// joint. The index of a vertex that names a joint which is not there; none: all was well.
std::optional<std::size_t> bend(scene::Mesh& mesh, const std::vector<MeshShape::Influences>& influences,
                                const std::vector<mat4>& joints);

}  // namespace ssphh::scene_io
