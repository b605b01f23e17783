#pragma once
/// What shading needs of the triangles of one instance, in world space and side by side: a hit touches one or
/// two cache lines instead of a dozen.

#include <vector>

#include <ssphh/scene/scene.h>
#include <ssphh/shading/surface.h>

namespace ssphh::trace {

class TriangleRecords {
 public:
  TriangleRecords() = default;
  /// `vertices` are the mesh's in world space; `uv_sets` tells which texture coordinates are wanted.
  TriangleRecords(const scene::Mesh& mesh, const std::vector<vec3>& vertices, const mat4& world,
                  const mat3& normal_matrix, const bool (&uv_sets)[2]);

  /// `magnitude` receives the largest coordinate of the triangle.
  shading::SurfaceGeometry at(std::uint32_t triangle, const vec2& barycentric, float& magnitude) const;

 private:
  static vec3 vec3_at(const float* p) { return {p[0], p[1], p[2]}; }

  std::size_t stride_ = 0, normals_ = 0, uvs_[2] = {0, 0};  ///< in floats; offsets are 0 where absent
  float mirror_ = 1;                                        ///< −1 where the instance is mirrored
  std::vector<float> floats_;
};

inline shading::SurfaceGeometry TriangleRecords::at(std::uint32_t triangle, const vec2& barycentric,
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
