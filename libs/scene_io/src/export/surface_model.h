#pragma once
/// Materials and lights as renderers see them that lack this project's models, and what they lose there.

#include <string>
#include <vector>

#include <ssphh/scene/scene.h>

#include "differences.h"
#include "flat_scene.h"
#include "texture_files.h"

namespace ssphh::scene_io {

enum class SurfaceKind {
  black,       ///< unlit: glows, reflects nothing
  lambert,     ///< no specular lobe
  dielectric,  ///< a diffuse base under a specular layer
  metal,
  mixture  ///< of both, by a factor or a texture
};
SurfaceKind surface_kind(const scene::Material& material);

/// Reflectance of the dielectric layer at normal incidence.
float normal_reflectance(const scene::Material& material);
/// The index of refraction that gives a normal reflectance, 0 ≤ f0 < 1.
float ior_of(float f0);
/// Roughness α of GGX and Beckmann; at least 1e-3, as in shading.
float roughness_alpha(float perceptual);

/// Radiance that leaves the surface where its texture is white.
vec3 glow(const scene::Material& material);
/// The texture that multiplies glow().
const scene::TextureUse& glow_texture(const scene::Material& material);

/// The share of a surface that is there: `value` everywhere, or by texels.
struct Coverage {
  float value = 1;
  std::string file;  ///< empty: constant
  bool full() const { return file.empty() && value >= 1; }
};
Coverage coverage(const scene::Scene& scene, const scene::Material& material, TextureFiles& files);

/// uv' = matrix · (u, v, 1), v down the image.
mat3 uv_matrix(const scene::TextureUse& use);
/// The first texture that the material uses, or one without a texture.
const scene::TextureUse& leading_texture(const scene::Material& material);
/// Texture coordinates of the mesh through `use`; zeros where the mesh has none, empty without a texture.
std::vector<vec2> texture_coordinates(const scene::Mesh& mesh, const scene::TextureUse& use);

/// An identifier in all formats: `kind` and index, then what letters and digits the name has.
std::string identifier(const char* kind, std::size_t index, const std::string& name);

/// The identifier of the material that a mesh is drawn with; "standard": the default one.
std::string material_id(const scene::Scene& scene, const FlatMesh& mesh);

/// What the format can do with textures; what it cannot is reported.
struct TextureAbilities {
  bool own_transform = false;  ///< every texture its own, not one for the material
  bool mirror = false, nearest = false;
};
/// Diffuse models, wrap modes, second coordinates, cut-outs: what Mitsuba, pbrt and Corona lose alike.
void note_material(const scene::Material& material, const TextureAbilities& abilities,
                   Differences& differences);
/// Ranges, cones, sizes.
void note_light(const scene::Light& light, Differences& differences);

}  // namespace ssphh::scene_io
