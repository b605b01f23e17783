#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>

#include "file_bytes.h"
#include "mtl.h"
#include "printable.h"

namespace ssphh::scene_io {
namespace {

using scene::AlphaMode;
using scene::Material;
using scene::Texture;
using scene::TextureUse;

constexpr std::uint64_t max_mtl_bytes = std::uint64_t{64} << 20;

// Roughness whose α = roughness² has the width of the Blinn–Phong lobe of exponent n: α² = 2/(n + 2)
// (Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007).
float roughness_of_exponent(float n) {
  return std::pow(2 / (std::max(n, 0.0f) + 2), 0.25f);
}

// File name as written on Windows or Unix; nullopt for absolute ones.
std::optional<std::filesystem::path> relative_path(std::string name) {
  std::ranges::replace(name, '\\', '/');
  const bool drive = name.size() > 1 && name[1] == ':';
  const std::filesystem::path path(name);
  if (drive || path.empty() || path.is_absolute() || name.find('\0') != name.npos) return std::nullopt;
  return path;
}

void convert_specular(const MtlMaterial& mtl, Material& out) {
  const float ks = max_component(mtl.ks);
  if (mtl.roughness || mtl.metallic) {
    out.specular_roughness = glm::clamp(mtl.roughness.value_or(1), 0.0f, 1.0f);
    out.metallic = glm::clamp(mtl.metallic.value_or(0), 0.0f, 1.0f);
    out.ior = mtl.ni > 1 ? mtl.ni : 1.5f;
    return;
  }
  if (ks == 0 || mtl.illum < 2) {
    out.specular = 0;
    return;
  }
  out.specular_roughness = mtl.illum >= 3 ? 0.0f : -roughness_of_exponent(mtl.ns);
  if (max_component(mtl.kd) <= 0.05f * ks) {
    out.metallic = 1;
    out.base_color = glm::min(mtl.ks, vec3(1));
    return;
  }
  // The index of refraction whose reflectance at normal incidence is Ks
  const float f0 = std::min((mtl.ks.x + mtl.ks.y + mtl.ks.z) / 3, 0.96f);
  out.ior = (1 + std::sqrt(f0)) / (1 - std::sqrt(f0));
}

// Models 6 and 7 refract: solid bodies, whose light passes the surface twice. Models 4 and 9 are "glass" that
// many writers choose for whatever is not quite there (d): a thin sheet only where a filter says so.
void convert_glass(const MtlMaterial& mtl, Material& out) {
  const bool body = mtl.illum == 6 || mtl.illum == 7;
  const bool sheet = (mtl.illum == 4 || mtl.illum == 9) && mtl.filter && out.alpha == 1;
  if (!body && !sheet) return;
  const vec3 filter = glm::min(mtl.filter.value_or(vec3(1)), vec3(1));
  out.transmission = out.specular = out.alpha = 1;
  out.metallic = 0;
  out.thickness = body ? 1.0f : 0.0f;
  out.base_color = body ? glm::sqrt(filter) : filter;
  out.ior = mtl.ni >= 1 ? mtl.ni : 1.5f;
  out.specular_roughness = glm::clamp(mtl.roughness.value_or(0), 0.0f, 1.0f);
}

}  // namespace

void MtlImport::add_library(const std::filesystem::path& path) {
  std::string text;
  try {
    text = read_text_file(path, max_mtl_bytes);
  } catch (const Error& e) {
    log_warning("{}; default materials stand in", e.what());
    return;
  }
  for (const MtlMaterial& mtl : parse_mtl(text, path.string(), ignored_)) {
    if (materials_.contains(mtl.name)) continue;
    materials_[mtl.name] = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(convert(mtl, path.parent_path()));
  }
}

int MtlImport::material(const std::string& name) {
  const auto [entry, is_new] = materials_.try_emplace(name, static_cast<int>(scene_.materials.size()));
  if (is_new) {
    if (!name.empty())
      log_warning("{}: material \"{}\" is not defined; a default stands in", scene_.name, name);
    scene_.materials.emplace_back().name = name;
    scene_.materials.back().specular = 0;
  }
  return entry->second;
}

Material MtlImport::convert(const MtlMaterial& mtl, const std::filesystem::path& folder) {
  Material out;
  out.name = mtl.name;
  out.base_color = mtl.kd;
  out.emission = mtl.ke;
  out.alpha = glm::clamp(mtl.dissolve.value_or(1 - mtl.transparency.value_or(0)), 0.0f, 1.0f);
  convert_specular(mtl, out);
  convert_glass(mtl, out);
  out.base_color_texture = use(mtl.map_kd, folder);
  out.emission_texture = use(mtl.map_ke, folder);
  out.normal_texture = use(mtl.normal, folder);
  out.normal_scale = mtl.normal.bump;
  if (!mtl.map_ke.file.empty() && mtl.ke == vec3(0)) out.emission = vec3(1);
  const TextureUse coverage = use(mtl.map_d, folder);
  if (coverage.texture >= 0) {
    const int color = out.base_color_texture.texture;
    if (color < 0) out.base_color_texture = coverage;
    out.base_color_texture.texture = coverage_texture(color, coverage.texture);
  }
  if (out.alpha < 1 || coverage.texture >= 0) out.alpha_mode = AlphaMode::blend;
  return out;
}

int MtlImport::texture(const std::filesystem::path& path) {
  const auto [entry, is_new] = textures_.try_emplace(path, -1);
  if (!is_new) return entry->second;
  try {
    auto decoded = image::decode_rgba8(read_file(path, max_image_bytes), path.string());
    entry->second = static_cast<int>(scene_.textures.size());
    scene_.textures.push_back(
        {printable(path.filename().string()), decoded.width, decoded.height, std::move(decoded.rgba)});
  } catch (const Error& e) {
    log_warning("{}; the texture is left out", e.what());
    ignored_.add("missing or unreadable texture");
  }
  return entry->second;
}

TextureUse MtlImport::use(const MtlTexture& mtl, const std::filesystem::path& folder) {
  TextureUse out;
  if (mtl.file.empty()) return out;
  const auto path = relative_path(mtl.file);
  if (!path) {
    log_warning("{}: the texture \"{}\" is not a relative file name; it is left out", folder.string(),
                mtl.file);
    ignored_.add("missing or unreadable texture");
    return out;
  }
  out.texture = texture(folder / *path);
  // OBJ counts v upwards, v = 1 − v', so that s·v + o becomes 1 − s − o + s·v'
  out.scale = mtl.scale;
  out.offset = {mtl.offset.x, 1 - mtl.scale.y - mtl.offset.y};
  if (mtl.clamp) out.wrap_u = out.wrap_v = scene::Wrap::clamp;
  return out;
}

// A texture with the colour of one (white when < 0) and the coverage of another: its alpha channel, or its
// red channel where alpha is 1 everywhere.
int MtlImport::coverage_texture(int color, int coverage) {
  const auto texture_at = [&](int i) -> const Texture& { return scene_.textures[i]; };
  const Texture& mask = texture_at(coverage);
  bool has_alpha = false;
  for (std::size_t i = 3; i < mask.rgba.size() && !has_alpha; i += 4) has_alpha = mask.rgba[i] != 255;
  if (color == coverage && has_alpha) return color;
  Texture out;
  if (color >= 0) {
    out = texture_at(color);
  } else {
    out.width = mask.width;
    out.height = mask.height;
    out.rgba.assign(mask.rgba.size(), 255);
  }
  out.name += " × coverage of " + mask.name;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const auto from_x = static_cast<std::size_t>(std::int64_t{x} * mask.width / out.width);
      const auto from_y = static_cast<std::size_t>(std::int64_t{y} * mask.height / out.height);
      const std::size_t from = (from_y * static_cast<std::size_t>(mask.width) + from_x) * 4;
      const auto to =
          (static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(x)) *
          4;
      out.rgba[to + 3] = mask.rgba[from + (has_alpha ? 3 : 0)];
    }
  }
  scene_.textures.push_back(std::move(out));
  return static_cast<int>(scene_.textures.size()) - 1;
}

}  // namespace ssphh::scene_io
