#include "clearance.h"

#include <algorithm>
#include <cmath>

#include <ssphh/scene/query.h>

#include "world_mesh.h"

namespace ssphh::lightmap {

Clearance::Clearance(const scene::Scene& scene, float time) {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  std::vector<geometry::Corners> triangles;
  for (const scene::Instance& instance : scene.instances) {
    if (instance.mesh < 0) continue;
    const WorldMesh mesh(scene, instance, world);
    for (const uvec3& t : mesh.mesh.triangles)
      triangles.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
  }
  tree_ = geometry::TriangleTree(triangles);
}

float Clearance::at(const vec3& x, const vec3& front) const {
  constexpr float rounding = 1e-4f;  // of a corner's distance
  const auto rises = [&](std::int32_t i) {
    return std::ranges::any_of(tree_.triangles()[i], [&](const vec3& corner) {
      return glm::dot(corner - x, front) > rounding * glm::distance(corner, x);
    });
  };
  return std::sqrt(tree_.nearest(x, std::numeric_limits<float>::infinity(), rises).place.distance2);
}

}  // namespace ssphh::lightmap
