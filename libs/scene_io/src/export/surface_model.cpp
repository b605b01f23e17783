#include "surface_model.h"

#include <cctype>
#include <cmath>

#include <fmt/format.h>

namespace ssphh::scene_io {
namespace {

bool same_coordinates(const scene::TextureUse& a, const scene::TextureUse& b) {
  return a.uv_set == b.uv_set && a.offset == b.offset && a.scale == b.scale && a.rotation == b.rotation;
}

}  // namespace

SurfaceKind surface_kind(const scene::Material& m) {
  if (m.unlit) return SurfaceKind::black;
  if (m.metallic == 0) return normal_reflectance(m) > 0 ? SurfaceKind::dielectric : SurfaceKind::lambert;
  if (m.metallic == 1 && m.metallic_roughness_texture.texture < 0) return SurfaceKind::metal;
  return SurfaceKind::mixture;
}

float normal_reflectance(const scene::Material& m) {
  const float r = (m.ior - 1) / (m.ior + 1);
  return r * r * m.specular;
}

float ior_of(float f0) {
  const float r = std::sqrt(glm::clamp(f0, 0.0f, 0.99f));
  return (1 + r) / (1 - r);
}

float roughness_alpha(float perceptual) {
  return glm::max(1e-3f, perceptual * perceptual);
}

vec3 glow(const scene::Material& m) {
  return m.unlit ? m.base_color : m.emission;
}

const scene::TextureUse& glow_texture(const scene::Material& m) {
  return m.unlit ? m.base_color_texture : m.emission_texture;
}

Coverage coverage(const scene::Scene& scene, const scene::Material& m, TextureFiles& files) {
  if (m.alpha_mode == scene::AlphaMode::opaque) return {};
  const bool mask = m.alpha_mode == scene::AlphaMode::mask;
  const auto final = [&](float alpha) {
    return mask ? (alpha >= m.alpha_cutoff ? 1.0f : 0.0f) : glm::clamp(alpha, 0.0f, 1.0f);
  };
  const int texture = m.base_color_texture.texture;
  if (texture < 0) return {final(m.alpha), {}};
  const std::vector<std::uint8_t>& rgba = scene.textures[texture].rgba;
  bool varies = false;
  for (std::size_t i = 3; i < rgba.size() && !varies; i += 4) varies = rgba[i] != 255;
  if (!varies) return {final(m.alpha), {}};
  const std::string kind = fmt::format("coverage {} {}", m.alpha, mask ? m.alpha_cutoff : -1);
  return {1, files.channel(texture, 3, kind, [&](float alpha) { return final(m.alpha * alpha); })};
}

mat3 uv_matrix(const scene::TextureUse& use) {
  // Counter-clockwise as seen on the image, whose v points down
  const float c = std::cos(use.rotation), s = std::sin(use.rotation);
  return {vec3(c * use.scale.x, -s * use.scale.x, 0), vec3(s * use.scale.y, c * use.scale.y, 0),
          vec3(use.offset.x, use.offset.y, 1)};
}

const scene::TextureUse& leading_texture(const scene::Material& m) {
  static const scene::TextureUse none;
  for (const scene::TextureUse* use : m.texture_uses()) {
    if (use->texture >= 0) return *use;
  }
  return none;
}

std::vector<vec2> texture_coordinates(const scene::Mesh& mesh, const scene::TextureUse& use) {
  if (use.texture < 0) return {};
  std::vector<vec2> result = mesh.uvs[use.uv_set];
  result.resize(mesh.positions.size(), vec2(0));
  const mat3 matrix = uv_matrix(use);
  for (vec2& uv : result) uv = vec2(matrix * vec3(uv, 1));
  return result;
}

std::string identifier(const char* kind, std::size_t index, const std::string& name) {
  std::string result = fmt::format("{}{}", kind, index);
  constexpr std::size_t longest = 48;
  bool gap = true;
  for (const char c : name) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 128;
    if (plain && gap) result += '_';
    if (plain) result += c;
    gap = !plain;
    if (result.size() >= longest) break;
  }
  return result;
}

std::string material_id(const scene::Scene& scene, const FlatMesh& mesh) {
  if (mesh.material < 0) return "standard";
  return identifier("material", static_cast<std::size_t>(mesh.material), material_of(scene, mesh).name);
}

void note_material(const scene::Material& m, const TextureAbilities& abilities, Differences& differences) {
  if (m.unlit) {
    differences.add("unlit surfaces light others", m.name);
  } else {
    if (m.diffuse_roughness != 0 && m.metallic < 1)
      differences.add("Oren-Nayar's and Disney's diffuse models become Lambert's", m.name);
    if (m.is_glass()) differences.add("glass becomes opaque, of its base colour", m.name);
    if (m.normal_texture.texture >= 0)
      differences.add("normal maps use tangents of the other renderer's own", m.name);
  }
  if (m.alpha_mode == scene::AlphaMode::mask && m.base_color_texture.texture >= 0)
    differences.add("cut-outs are cut at texels and their edge interpolated", m.name);
  const scene::TextureUse& first = leading_texture(m);
  for (const scene::TextureUse* use : m.texture_uses()) {
    if (use->texture < 0) continue;
    const bool lost = abilities.own_transform ? use->uv_set != first.uv_set : !same_coordinates(*use, first);
    if (lost) differences.add("all textures take the coordinates of the material's first", m.name);
    if (use->wrap_u != use->wrap_v) differences.add("the wrap mode of u is taken for v as well", m.name);
    if (use->wrap_u == scene::Wrap::mirror && !abilities.mirror)
      differences.add("mirrored textures repeat instead", m.name);
    if (use->nearest && !abilities.nearest)
      differences.add("textures are interpolated that should not be", m.name);
  }
}

void note_light(const scene::Light& light, Differences& differences) {
  if (light.range > 0) differences.add("lights reach beyond their range", light.name);
  if (light.type == scene::LightType::sphl)
    differences.add("SPHLs that shine become point lights: as much light, into all directions alike",
                    light.name);
  if (!light.has_profile()) return;
  differences.add(light.type == scene::LightType::point
                      ? "lamps with a photometric profile shine into all directions alike: as much light"
                      : "spots have no photometric profile: as bright everywhere between their cones",
                  light.name);
}

}  // namespace ssphh::scene_io
