#include "material_lookup.h"

namespace ssphh::shading {

const scene::Material& material_at(const scene::Scene& scene, int material) {
  static const scene::Material plain;
  return material < 0 ? plain : scene.materials[material];
}

void interpolate_uvs(const scene::Mesh& mesh, const Corners& at, vec2 (&uv)[2]) {
  for (std::size_t set = 0; set < 2; ++set) {
    uv[set] = mesh.uvs[set].empty() ? vec2(0) : at.interpolate(mesh.uvs[set]);
  }
}

vec4 base_color_at(const scene::Scene& scene, const scene::Mesh& mesh, const scene::Material& material,
                   const Corners& at, const vec2 (&uv)[2]) {
  vec4 color(material.base_color, material.alpha);
  if (material.base_color_texture.texture >= 0)
    color *= sample_texture(scene, material.base_color_texture, uv, true);
  if (!mesh.colors.empty()) color *= at.interpolate(mesh.colors);
  switch (material.alpha_mode) {
    case scene::AlphaMode::opaque:
      color.a = 1;
      break;
    case scene::AlphaMode::mask:
      color.a = color.a >= material.alpha_cutoff ? 1.0f : 0.0f;
      break;
    case scene::AlphaMode::blend:
      color.a = glm::clamp(color.a, 0.0f, 1.0f);
      break;
  }
  return color;
}

vec3 emission_at(const scene::Scene& scene, const scene::Material& material, const vec2 (&uv)[2]) {
  if (material.emission_texture.texture < 0) return material.emission;
  return material.emission * vec3(sample_texture(scene, material.emission_texture, uv, true));
}

}  // namespace ssphh::shading
