#pragma once
/// What surfaces and area lights both ask of a material.

#include <ssphh/shading/surface.h>

namespace ssphh::shading {

/// uv' = translate(offset) · rotate(rotation) · scale(scale) · uv, before wrapping.
vec2 transform_uv(const scene::TextureUse& use, const vec2& uv);

/// The same for a difference of texture coordinates: without the offset.
vec2 transform_uv_direction(const scene::TextureUse& use, const vec2& uv);

/// Material by index; −1: the default.
const scene::Material& material_at(const scene::Scene& scene, int material);

/// Values interpolated over a triangle from its corners' weights.
struct Corners {
  uvec3 index{0};
  vec3 weight{0};

  Corners() = default;
  Corners(const scene::Mesh& mesh, std::uint32_t triangle, const vec2& barycentric)
      : index(mesh.triangles[triangle]),
        weight(1 - barycentric.x - barycentric.y, barycentric.x, barycentric.y) {}

  template <class T>
  T interpolate(const std::vector<T>& values) const {
    return weight.x * values[index.x] + weight.y * values[index.y] + weight.z * values[index.z];
  }
};

/// Texture coordinates at a point; (0, 0) for a set the mesh lacks.
void interpolate_uvs(const scene::Mesh& mesh, const Corners& at, vec2 (&uv)[2]);

/// Base colour and alpha: factor × texture × vertex colour. Alpha is the coverage after the alpha mode.
vec4 base_color_at(const scene::Scene& scene, const scene::Mesh& mesh, const scene::Material& material,
                   const Corners& at, const vec2 (&uv)[2]);

/// Radiance emitted by the lit side, coverage not counted; unlit materials not included.
vec3 emission_at(const scene::Scene& scene, const scene::Material& material, const vec2 (&uv)[2]);

}  // namespace ssphh::shading
