#pragma once
/// From a hit on a mesh to the shading inputs: normals, textures, material parameters.

#include <ssphh/scene/scene.h>
#include <ssphh/shading/bsdf.h>

namespace ssphh::shading {

/// Everything an integrator needs of a hit. Normals face the side the ray came from.
struct Surface {
  vec3 position;
  vec3 geometric_normal;  ///< unit, toward wo
  vec3 normal;            ///< unit shading normal (interpolated, normal-mapped), in wo's hemisphere
  BsdfParams bsdf;
  vec3 emission{0};  ///< radiance toward wo
  float alpha = 1;   ///< coverage after alpha mode: 0 or 1 for opaque and mask, 0..1 for blend
  bool unlit = false;
};

/// `barycentric` are the weights of the triangle's second and third vertex (Embree's u, v); `wo` points to
/// where the ray came from, world space. `normal_matrix` is the inverse transpose of the world matrix's 3×3
/// part.
Surface surface_at(const scene::Scene& scene, const scene::Mesh& mesh, int material, std::uint32_t triangle,
                   const vec2& barycentric, const mat4& world, const mat3& normal_matrix, const vec3& wo);

/// Texture lookup with bilinear filtering (or nearest) and wrapping; RGBA in 0..1, RGB decoded from sRGB if
/// asked. Without a texture: all ones.
vec4 sample_texture(const scene::Scene& scene, const scene::TextureUse& use, const vec2 (&uv)[2], bool srgb);

}  // namespace ssphh::shading
