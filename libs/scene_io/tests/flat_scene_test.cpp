#include "export/flat_scene.h"

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

namespace ssphh::scene_io {
namespace {

// Whatever the node's mirroring and the file's normals, fronts look outward and normals with them.
TEST(FlatScene, FrontsAndNormalsLookOutward) {
  for (const bool mirrored : {false, true}) {
    for (const bool inward : {false, true}) {
      scene::Scene s;
      s.meshes.push_back(scene::make_sphere(1, 8, 4));
      if (inward) {
        for (vec3& n : s.meshes[0].normals) n = -n;
      }
      scene::Node node;
      node.local.translation = {3, 1, 2};
      node.local.scale = {mirrored ? -2.0f : 2.0f, 1, 1};
      s.nodes.push_back(node);
      s.instances.push_back({0, 0, -1, {}});
      const FlatScene flat = flatten(s, 0);
      ASSERT_EQ(flat.meshes.size(), 1u);
      const scene::Mesh& mesh = flat.meshes[0].mesh;
      for (const uvec3& t : mesh.triangles) {
        const vec3 a = mesh.positions[t.x];
        const vec3 front = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
        EXPECT_GT(glm::dot(front, a - vec3(3, 1, 2)), 0);
        for (int c = 0; c < 3; ++c) EXPECT_GT(glm::dot(front, mesh.normals[t[c]]), 0);
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::scene_io
