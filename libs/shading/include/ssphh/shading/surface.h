#pragma once
/// From a hit on a mesh to the shading inputs: normals, textures, material parameters.

#include <ssphh/scene/scene.h>
#include <ssphh/shading/bsdf.h>
#include <ssphh/shading/glass.h>

namespace ssphh::shading {

/// Everything an integrator needs of a hit. Normals face the side the ray came from.
struct Surface {
  vec3 position;
  vec3 geometric_normal;  ///< unit, toward wo
  vec3 normal;            ///< unit shading normal (interpolated, normal-mapped), in wo's hemisphere
  BsdfParams bsdf;        ///< of what is not glass
  GlassParams glass;      ///< share 0: there is none
  vec3 emission{0};       ///< radiance toward wo
  float alpha = 1;        ///< coverage after alpha mode: 0 or 1 for opaque and mask, 0..1 for blend
  bool unlit = false;
};

/// The geometry of a hit, world space.
struct SurfaceGeometry {
  vec3 position{0};
  vec3 front{0};   ///< normal of the triangle's front side, any length; zero: degenerate
  vec3 normal{0};  ///< interpolated vertex normal, any length; zero: none
  vec2 uv[2] = {vec2(0), vec2(0)};
};

/// `barycentric` are the weights of the triangle's second and third vertex (Embree's u, v); `wo` points to
/// where the ray came from, world space. `normal_matrix` is the inverse transpose of the world matrix's 3×3
/// part.
Surface surface_at(const scene::Scene& scene, const scene::Mesh& mesh, int material, std::uint32_t triangle,
                   const vec2& barycentric, const mat4& world, const mat3& normal_matrix, const vec3& wo);

/// The same where the geometry is known already. What is left of the mesh is read for vertex colours and
/// normal maps only; `geometry` needs the texture coordinates of the sets that the material uses.
Surface surface_of(const SurfaceGeometry& geometry, const scene::Scene& scene, const scene::Mesh& mesh,
                   int material, std::uint32_t triangle, const vec2& barycentric, const mat4& world,
                   const vec3& wo);

/// Surface::alpha alone.
float coverage_at(const scene::Scene& scene, const scene::Mesh& mesh, int material, std::uint32_t triangle,
                  const vec2& barycentric);

/// Share of the light from a direction of view that leaves the surface again, reflected or through glass; an
/// estimate.
vec3 surface_albedo(const Surface& surface, float cos_o);

/// What a body of glass absorbs [1/m]: after `attenuation_distance` light has its `attenuation_color`. 0 for
/// a sheet.
vec3 absorption_of(const scene::Material& material);

/// Surface::glass alone, as seen from outside.
GlassParams glass_at(const scene::Scene& scene, const scene::Mesh& mesh, int material, std::uint32_t triangle,
                     const vec2& barycentric);

/// Texture lookup with bilinear filtering (or nearest) and wrapping; RGBA in 0..1, RGB decoded from sRGB if
/// asked. Without a texture: all ones.
vec4 sample_texture(const scene::Scene& scene, const scene::TextureUse& use, const vec2 (&uv)[2], bool srgb);

}  // namespace ssphh::shading
