#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/image/io.h>

#include "gltf_export_parts.h"
#include "gltf_names.h"

namespace ssphh::scene_io {
namespace {

using scene::AlphaMode;
using scene::Material;
using scene::TextureUse;
using scene::Wrap;

int export_image(GltfExport& out, int texture) {
  const auto known = out.images_by_texture.find(texture);
  if (known != out.images_by_texture.end()) return known->second;
  const scene::Texture& t = out.scene.textures[texture];
  const auto png = image::encode_png(image::Rgba8{t.width, t.height, t.rgba});
  json::Value image;
  if (!t.name.empty()) image["name"] = t.name;
  image["mimeType"] = "image/png";
  image["bufferView"] = add_buffer_view(out, png, 0);
  return out.images_by_texture[texture] = push(out.images, std::move(image));
}

unsigned wrap_code(Wrap wrap) {
  return std::ranges::find(gltf_wraps, wrap, &std::pair<Wrap, unsigned>::first)->second;
}

int export_sampler(GltfExport& out, const TextureUse& use) {
  const std::tuple key(wrap_code(use.wrap_u), wrap_code(use.wrap_v), use.nearest);
  const auto known = out.samplers_by_wrap.find(key);
  if (known != out.samplers_by_wrap.end()) return known->second;
  json::Value sampler = {{"magFilter", use.nearest ? 9728 : 9729},
                         {"minFilter", use.nearest ? 9728 : 9987},
                         {"wrapS", std::get<0>(key)},
                         {"wrapT", std::get<1>(key)}};
  return out.samplers_by_wrap[key] = push(out.samplers, std::move(sampler));
}

/// textureInfo of a use; null when there is none.
json::Value export_use(GltfExport& out, const TextureUse& use) {
  if (use.texture < 0) return nullptr;
  const std::pair key(export_image(out, use.texture), export_sampler(out, use));
  const auto known = out.textures_by_parts.find(key);
  const int texture = known != out.textures_by_parts.end()
                          ? known->second
                          : push(out.textures, {{"sampler", key.second}, {"source", key.first}});
  out.textures_by_parts[key] = texture;

  json::Value info = {{"index", texture}};
  if (use.uv_set != 0) info["texCoord"] = use.uv_set;
  json::Value transform;
  if (use.offset != vec2(0)) transform["offset"] = numbers(std::span(&use.offset.x, 2));
  if (use.rotation != 0) transform["rotation"] = number(use.rotation);
  if (use.scale != vec2(1)) transform["scale"] = numbers(std::span(&use.scale.x, 2));
  if (!transform.is_null()) add_extension(out, info, "KHR_texture_transform", std::move(transform));
  return info;
}

void set_unless_null(json::Value& object, const char* key, json::Value value) {
  if (!value.is_null()) object[key] = std::move(value);
}

/// emissiveFactor may not exceed 1: the rest is a power of two, which loses no bit.
void export_emission(GltfExport& out, const Material& m, json::Value& material) {
  const float largest = max_component(m.emission);
  if (!(largest > 0)) return;
  int exponent = 0;
  if (largest > 1) std::frexp(largest, &exponent);
  const float strength = std::ldexp(1.0f, exponent);
  material["emissiveFactor"] = numbers(m.emission / strength);
  if (exponent > 0) {
    add_extension(out, material, "KHR_materials_emissive_strength", {{"emissiveStrength", number(strength)}});
  }
}

void export_glass(GltfExport& out, const Material& m, json::Value& material) {
  if (m.transmission > 0 || m.transmission_texture.texture >= 0) {
    json::Value transmission = {{"transmissionFactor", number(m.transmission)}};
    set_unless_null(transmission, "transmissionTexture", export_use(out, m.transmission_texture));
    add_extension(out, material, "KHR_materials_transmission", std::move(transmission));
  }
  json::Value volume;
  if (m.thickness > 0) volume["thicknessFactor"] = number(m.thickness);
  if (m.attenuation_color != vec3(1))
    volume["attenuationColor"] = numbers(std::span(&m.attenuation_color.x, 3));
  if (m.attenuation_distance > 0) volume["attenuationDistance"] = number(m.attenuation_distance);
  if (!volume.is_null()) add_extension(out, material, "KHR_materials_volume", std::move(volume));
}

/// What validate() would clamp is no material: a file of it would be read as another one.
void check_range(const Material& m) {
  const auto within = [&](const char* what, std::span<const float> values, float low, float high) {
    for (const float value : values) {
      if (value >= low && value <= high) continue;
      throw Error(fmt::format("material \"{}\"", m.name),
                  fmt::format("its {} is {:g}, not from {:g} {}", what, value, low,
                              std::isinf(high) ? "on" : fmt::format("to {:g}", high)));
    }
  };
  const auto color = [](const vec3& v) { return std::span<const float>(&v.x, 3); };
  const auto one = [](const float& v) { return std::span<const float>(&v, 1); };
  within("base colour", color(m.base_color), 0, 1);
  within("attenuation colour", color(m.attenuation_color), 0, 1);
  within("emission", color(m.emission), 0, HUGE_VALF);
  within("alpha", one(m.alpha), 0, 1);
  within("metallic", one(m.metallic), 0, 1);
  within("diffuse roughness", one(m.diffuse_roughness), -1, 1);
  within("specular roughness", one(m.specular_roughness), -1, 1);
  within("specular", one(m.specular), 0, 1);
  within("transmission", one(m.transmission), 0, 1);
  within("thickness", one(m.thickness), 0, HUGE_VALF);
}

json::Value export_material(GltfExport& out, const Material& m) {
  check_range(m);
  json::Value material;
  if (!m.name.empty()) material["name"] = m.name;
  const vec4 color(m.base_color, m.alpha);
  json::Value pbr = {{"baseColorFactor", numbers(std::span(&color.x, 4))},
                     {"metallicFactor", number(m.metallic)},
                     {"roughnessFactor", number(std::abs(m.specular_roughness))}};
  set_unless_null(pbr, "baseColorTexture", export_use(out, m.base_color_texture));
  set_unless_null(pbr, "metallicRoughnessTexture", export_use(out, m.metallic_roughness_texture));
  material["pbrMetallicRoughness"] = std::move(pbr);
  json::Value normal = export_use(out, m.normal_texture);
  if (!normal.is_null() && m.normal_scale != 1) normal["scale"] = number(m.normal_scale);
  set_unless_null(material, "normalTexture", std::move(normal));
  set_unless_null(material, "emissiveTexture", export_use(out, m.emission_texture));
  export_emission(out, m, material);
  if (m.alpha_mode != AlphaMode::opaque) material["alphaMode"] = name_in(gltf_alpha_modes, m.alpha_mode);
  if (m.alpha_mode == AlphaMode::mask) material["alphaCutoff"] = number(m.alpha_cutoff);
  if (m.double_sided) material["doubleSided"] = true;

  if (m.specular != 1) {
    add_extension(out, material, "KHR_materials_specular", {{"specularFactor", number(m.specular)}});
  }
  export_glass(out, m, material);
  if (m.ior != 1.5f) add_extension(out, material, "KHR_materials_ior", {{"ior", number(m.ior)}});
  if (m.unlit) add_extension(out, material, "KHR_materials_unlit", json::Value::object());

  json::Value bipolar;
  if (m.diffuse_roughness != 0) bipolar["diffuse_roughness"] = number(m.diffuse_roughness);
  if (std::signbit(m.specular_roughness)) bipolar["specular_roughness"] = number(m.specular_roughness);
  if (!bipolar.is_null()) material["extras"]["ssphh"] = std::move(bipolar);
  return material;
}

}  // namespace

void export_materials(GltfExport& out) {
  for (const Material& m : out.scene.materials) out.materials.push_back(export_material(out, m));
}

int export_material_index(GltfExport& out, int material) {
  if (material >= 0) return material;
  // glTF's own default is another one, a white metal.
  if (out.default_material < 0) out.default_material = push(out.materials, export_material(out, Material{}));
  return out.default_material;
}

}  // namespace ssphh::scene_io
