#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>

#include "file_bytes.h"
#include "gltf_names.h"
#include "gltf_parts.h"
#include "uri.h"

namespace ssphh::scene_io {
namespace {

using scene::Material;
using scene::TextureUse;
using scene::Wrap;

// Scene texture of a glTF image; −1 when it cannot be used, which is a warning: the factors still stand.
int import_image(GltfImport& import, int index) {
  int& texture = import.texture_of_image[index];
  if (texture != -2) return texture;
  texture = -1;
  const json::Cursor image = import.document.item("images", index);
  const std::string where = fmt::format("{}: {}", image.file(), image.path());
  std::vector<std::byte> storage;
  const auto bytes = image_bytes(import.document, image, storage);
  if (bytes.empty()) return texture;
  try {
    auto decoded = image::decode_rgba8(bytes, where);
    texture = static_cast<int>(import.scene.textures.size());
    import.scene.textures.push_back({image.text_or("name", fmt::format("image {}", index)), decoded.width,
                                     decoded.height, std::move(decoded.rgba)});
  } catch (const Error& e) {
    log_warning("{}; the texture is left out", e.what());
    import.document.ignored.add("unreadable image");
  }
  return texture;
}

Wrap import_wrap(const json::Cursor& sampler, const char* key) {
  const auto member = sampler.find(key);
  const auto code = member ? member->unsigned_integer() : 10497;
  for (const auto& [wrap, number] : gltf_wraps)
    if (code == number) return wrap;
  member->fail(fmt::format("{} is no wrap mode", code));
}

// What EXT_texture_webp names is meant; beside it a PNG or JPEG may stand for readers that know no WebP.
std::optional<int> texture_source(const GltfDocument& document, const json::Cursor& texture) {
  const auto webp = extension(texture, "EXT_texture_webp");
  const auto source = webp ? document.reference(*webp, "source", "images") : std::nullopt;
  return source ? source : document.reference(texture, "source", "images");
}

std::string advice_on_texture(const json::Cursor& texture) {
  if (const auto extensions = texture.find("extensions")) {
    for (const auto& [name, unused] : extensions->entries())
      if (const auto advice = advice_on(name); !advice.empty()) return fmt::format(" ({})", advice);
  }
  return {};
}

// textureInfo: index, texCoord, KHR_texture_transform; image and sampler of the texture.
TextureUse import_texture(GltfImport& import, const json::Cursor& material, const char* key) {
  TextureUse use;
  const auto info = material.find(key);
  if (!info) return use;
  const GltfDocument& document = import.document;
  const json::Cursor texture =
      document.item("textures", (*info)["index"].index(document.count("textures"), "textures"));
  const auto source = texture_source(document, texture);
  if (!source) {
    log_warning("{}: {} has no PNG, JPEG or WebP image; the texture is left out{}", texture.file(),
                texture.path(), advice_on_texture(texture));
    import.document.ignored.add("texture without a PNG, JPEG or WebP image");
    return use;
  }
  const auto coordinates = [](const json::Cursor& object, int fallback) {
    const auto set = object.find("texCoord");
    return set ? static_cast<int>(set->unsigned_integer(1000)) : fallback;
  };
  use.uv_set = coordinates(*info, 0);
  if (const auto transform = extension(*info, "KHR_texture_transform")) {
    if (const auto offset = transform->find("offset")) use.offset = offset->vector2();
    if (const auto scale = transform->find("scale")) use.scale = scale->vector2();
    use.rotation = transform->number_or("rotation", 0);
    use.uv_set = coordinates(*transform, use.uv_set);
  }
  if (const auto sampler_index = document.reference(texture, "sampler", "samplers")) {
    const json::Cursor sampler = document.item("samplers", *sampler_index);
    use.wrap_u = import_wrap(sampler, "wrapS");
    use.wrap_v = import_wrap(sampler, "wrapT");
    const auto filter = sampler.find("magFilter");
    use.nearest = filter && filter->unsigned_integer() == 9728;
  }
  if (use.uv_set > 1) {
    import.document.ignored.add("texture with texture coordinate set above 1");
    return {};
  }
  use.texture = import_image(import, *source);
  return use.texture < 0 ? TextureUse{} : use;
}

void import_metallic_roughness(GltfImport& import, const json::Cursor& pbr, Material& out) {
  if (const auto color = pbr.find("baseColorFactor")) {
    const vec4 rgba = color->vector4();
    out.base_color = vec3(rgba);
    out.alpha = rgba.w;
  }
  out.metallic = pbr.number_or("metallicFactor", 1);
  out.specular_roughness = pbr.number_or("roughnessFactor", 1);
  out.base_color_texture = import_texture(import, pbr, "baseColorTexture");
  out.metallic_roughness_texture = import_texture(import, pbr, "metallicRoughnessTexture");
}

// What KHR_materials_volume says is of no use where nothing goes in.
void import_glass(GltfImport& import, const json::Cursor& material, Material& out) {
  const auto transmission = extension(material, "KHR_materials_transmission");
  if (!transmission) return;
  if (const auto factor = transmission->find("transmissionFactor")) out.transmission = factor->number(0, 1);
  out.transmission_texture = import_texture(import, *transmission, "transmissionTexture");
  const auto volume = extension(material, "KHR_materials_volume");
  if (!volume) return;
  if (const auto thickness = volume->find("thicknessFactor")) out.thickness = thickness->number(0, HUGE_VALF);
  if (const auto color = volume->find("attenuationColor")) out.attenuation_color = color->vector3();
  if (const auto distance = volume->find("attenuationDistance")) {
    out.attenuation_distance = distance->number();
    if (!(out.attenuation_distance > 0)) distance->fail("must be greater than 0");
  }
  if (volume->find("thicknessTexture"))
    import.document.ignored.add("KHR_materials_volume.thicknessTexture (bodies are as thick as their mesh)");
}

void import_extensions(GltfImport& import, const json::Cursor& material, Material& out) {
  if (const auto strength = extension(material, "KHR_materials_emissive_strength")) {
    if (const auto value = strength->find("emissiveStrength")) out.emission *= value->number(0, HUGE_VALF);
  }
  if (const auto ior = extension(material, "KHR_materials_ior")) {
    const float value = ior->number_or("ior", 1.5f);
    // 0 stands for the old specular-glossiness workflow's Fresnel term of 1
    if (value != 0 && value < 1) (*ior)["ior"].fail(fmt::format("{} must be 0 or at least 1", value));
    out.ior = value == 0 ? 1e6f : value;
  }
  if (const auto specular = extension(material, "KHR_materials_specular")) {
    if (const auto factor = specular->find("specularFactor")) out.specular = factor->number(0, 1);
    for (const char* key : {"specularColorFactor", "specularColorTexture", "specularTexture"}) {
      if (specular->find(key)) import.document.ignored.add(fmt::format("KHR_materials_specular.{}", key));
    }
  }
  import_glass(import, material, out);
  out.unlit = extension(material, "KHR_materials_unlit").has_value();
}

Material import_material(GltfImport& import, const json::Cursor& material) {
  Material out;
  out.name = material.text_or("name");
  out.base_color = vec3(1);
  out.metallic = 1;
  if (const auto pbr = material.find("pbrMetallicRoughness")) import_metallic_roughness(import, *pbr, out);
  if (const auto emission = material.find("emissiveFactor")) out.emission = emission->vector3();
  out.emission_texture = import_texture(import, material, "emissiveTexture");
  if (const auto normal = material.find("normalTexture")) {
    out.normal_texture = import_texture(import, material, "normalTexture");
    out.normal_scale = normal->number_or("scale", 1);
  }
  if (const auto occlusion = material.find("occlusionTexture")) {
    (*occlusion)["index"].index(import.document.count("textures"), "textures");
    import.document.ignored.add("occlusion texture");  // light transport makes its own occlusion
  }
  if (const auto mode = material.find("alphaMode")) out.alpha_mode = read_word(gltf_alpha_modes, *mode);
  out.alpha_cutoff = material.number_or("alphaCutoff", 0.5f);
  out.double_sided = material.boolean_or("doubleSided", false);
  import_extensions(import, material, out);

  // Bipolar roughness of this project's extras
  if (const auto bipolar = extra(material, "ssphh")) {
    if (const auto r = bipolar->find("diffuse_roughness")) out.diffuse_roughness = r->number(-1, 1);
    if (const auto r = bipolar->find("specular_roughness")) out.specular_roughness = r->number(-1, 1);
  }
  return out;
}

}  // namespace

std::span<const std::byte> image_bytes(GltfDocument& document, const json::Cursor& image,
                                       std::vector<std::byte>& storage) {
  if (const auto view = document.reference(image, "bufferView", "bufferViews")) {
    return document.buffer_view(*view).bytes;
  }
  const json::Cursor uri = image["uri"];
  const std::string where = fmt::format("{}: {}", uri.file(), uri.path());
  if (auto decoded = decode_data_uri(uri.text(), where)) {
    storage = *std::move(decoded);
    return storage;
  }
  const auto path = resolve_uri(uri.text(), document.path(), where);
  try {
    storage = read_file(path, max_image_bytes);
  } catch (const Error& e) {
    log_warning("{}: {}; the image is left out", where, e.what());
    document.ignored.add("missing image file");
  }
  return storage;
}

void import_materials(GltfImport& import) {
  import.texture_of_image.assign(import.document.count("images"), -2);
  for (const json::Cursor& material : import.document.items("materials"))
    import.scene.materials.push_back(import_material(import, material));
}

}  // namespace ssphh::scene_io
