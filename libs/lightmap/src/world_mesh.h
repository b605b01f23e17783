#pragma once
/// An instance's mesh in the world.

#include <span>

#include <ssphh/scene/query.h>

namespace ssphh::lightmap {

struct WorldMesh {
  const scene::Mesh& mesh;
  std::vector<vec3> positions;  ///< [m]
  std::vector<vec3> normals;    ///< unit; empty: geometric ones
  bool mirrored = false;        ///< fronts are clockwise
  bool moves = false;           ///< an animation moves it

  WorldMesh(const scene::Scene& scene, const scene::Instance& instance, std::span<const mat4> world);

  /// Cross product of the edges on the front side: twice the area long [m²].
  vec3 front(const uvec3& t) const {
    const vec3 n = glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
    return mirrored ? -n : n;
  }
};

}  // namespace ssphh::lightmap
