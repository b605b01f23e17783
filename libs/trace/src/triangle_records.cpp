#include "triangle_records.h"

namespace ssphh::trace {

TriangleRecords::TriangleRecords(const scene::Mesh& mesh, const std::vector<vec3>& vertices,
                                 const mat4& world, const mat3& normal_matrix, const bool (&uv_sets)[2])
    : mirror_(glm::determinant(mat3(world)) < 0 ? -1.0f : 1.0f) {
  // Lay out a record: three corners, then three normals and texture coordinates where wanted
  stride_ = 9;
  if (!mesh.normals.empty()) normals_ = stride_, stride_ += 9;
  for (std::size_t set = 0; set < 2; ++set) {
    if (uv_sets[set] && !mesh.uvs[set].empty()) uvs_[set] = stride_, stride_ += 6;
  }

  floats_.reserve(mesh.triangles.size() * stride_);
  const auto put = [&](const vec3& v) { floats_.insert(floats_.end(), {v.x, v.y, v.z}); };
  for (const uvec3& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(vertices[triangle[i]]);
    // Not normalised: they are interpolated as the mesh's own are
    for (int i = 0; normals_ && i < 3; ++i) put(normal_matrix * mesh.normals[triangle[i]]);
    for (std::size_t set = 0; set < 2; ++set) {
      for (int i = 0; uvs_[set] && i < 3; ++i) {
        const vec2& uv = mesh.uvs[set][triangle[i]];
        floats_.insert(floats_.end(), {uv.x, uv.y});
      }
    }
  }
}

}  // namespace ssphh::trace
