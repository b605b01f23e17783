/// A triangle's record gives back what the mesh says, whichever of its parts are kept.

#include "triangle_records.h"

#include <gtest/gtest.h>

#include <ssphh/core/random.h>

namespace ssphh::trace {
namespace {

constexpr float rounding = 1e-6f;  ///< of sums of three floats below 1

/// Two triangles with all that a mesh may have, every number another.
scene::Mesh full_mesh() {
  Pcg32 random(5);
  scene::Mesh mesh;
  for (int i = 0; i < 5; ++i) {
    mesh.positions.emplace_back(random.uniform(), random.uniform(), random.uniform());
    mesh.normals.emplace_back(random.uniform(), random.uniform(), 1);
    for (auto& uvs : mesh.uvs) uvs.emplace_back(random.uniform(), random.uniform());
  }
  mesh.triangles = {{0, 1, 2}, {4, 2, 3}};
  return mesh;
}

TEST(TriangleRecords, GiveBackNormalsAndBothSetsOfCoordinates) {
  const vec2 at(0.2f, 0.3f);
  for (const int kept : {0, 1, 2, 3}) {
    for (const bool normals : {false, true}) {
      scene::Mesh mesh = full_mesh();
      if (!normals) mesh.normals.clear();
      const bool sets[2] = {(kept & 1) != 0, (kept & 2) != 0};
      const TriangleRecords records(mesh, mesh.positions, mat4(1), mat3(1), sets);
      for (std::uint32_t t = 0; t < 2; ++t) {
        const auto interpolated = [&](const auto& values) {
          const uvec3& corner = mesh.triangles[t];
          return (1 - at.x - at.y) * values[corner.x] + at.x * values[corner.y] + at.y * values[corner.z];
        };
        float magnitude = 0;
        const shading::SurfaceGeometry found = records.at(t, at, magnitude);
        EXPECT_LT(glm::distance(found.position, interpolated(mesh.positions)), rounding);
        if (normals) {
          EXPECT_LT(glm::distance(found.normal, interpolated(mesh.normals)), rounding) << "sets " << kept;
        }
        for (std::size_t set = 0; set < 2; ++set)
          EXPECT_EQ(found.uv[set], sets[set] ? interpolated(mesh.uvs[set]) : vec2(0))
              << set << " of " << kept;
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::trace
