#include "triangle_records.h"

#include "rays.h"

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

shading::SurfaceGeometry TriangleRecords::at(std::uint32_t triangle, const vec2& barycentric,
                                             float& magnitude) const {
  const float* record = &floats_[triangle * stride_];
  const float a = 1 - barycentric.x - barycentric.y, b = barycentric.x, c = barycentric.y;
  const vec3 p0 = vec3_at(record), p1 = vec3_at(record + 3), p2 = vec3_at(record + 6);
  magnitude = max_component(glm::max(glm::abs(p0), glm::max(glm::abs(p1), glm::abs(p2))));

  shading::SurfaceGeometry geometry;
  geometry.position = a * p0 + b * p1 + c * p2;
  geometry.front = mirror_ * glm::cross(p1 - p0, p2 - p0);
  if (normals_) {
    const float* n = record + normals_;
    geometry.normal = a * vec3_at(n) + b * vec3_at(n + 3) + c * vec3_at(n + 6);
  }
  for (std::size_t set = 0; set < 2; ++set) {
    if (!uvs_[set]) continue;
    const float* uv = record + uvs_[set];
    geometry.uv[set] = a * vec2(uv[0], uv[1]) + b * vec2(uv[2], uv[3]) + c * vec2(uv[4], uv[5]);
  }
  return geometry;
}

}  // namespace ssphh::trace
