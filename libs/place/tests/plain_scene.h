#pragma once
/// A plain with something on it: what regions are found on.

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "triangle_source.h"

namespace ssphh::place {

/// Says where the triangles of part 0 are: a point in the middle of each.
class SampledSource : public test::TriangleSource {
 public:
  explicit SampledSource(const scene::Scene& scene) : TriangleSource(scene), scene_(scene) {}
  std::vector<rays::PartPoint> sample_part(int part, double) const override {
    EXPECT_EQ(part, 0);
    std::vector<rays::PartPoint> points;
    for (const scene::Mesh& mesh : scene_.meshes) {
      for (const uvec3& t : mesh.triangles) {
        const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        points.push_back({{(a + b + c) / 3.0f, glm::normalize(glm::cross(b - a, c - a))}, vec3(0.5f)});
      }
    }
    return points;
  }

 private:
  const scene::Scene& scene_;
};

inline void add(scene::Scene& scene, scene::Mesh mesh) {
  scene.nodes.emplace_back();
  scene.meshes.push_back(std::move(mesh));
  scene::Instance& instance = scene.instances.emplace_back();
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = static_cast<int>(scene.nodes.size()) - 1;
}

inline scene::Scene plain(float half) {
  scene::Scene scene;
  add(scene, scene::make_quad({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}));
  return scene;
}

/// Blocks of a metre side by side, 6 m by 6, from `corner` on.
inline void add_blocks(scene::Scene& scene, const vec3& corner) {
  for (int i = 0; i < 9; ++i) {
    const vec3 at = corner + vec3(2.0f * static_cast<float>(i % 3), 0, 2.0f * static_cast<float>(i / 3));
    add(scene, scene::make_box(at, at + vec3(2, 1, 2)));
  }
}

}  // namespace ssphh::place
