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

}  // namespace ssphh::trace
