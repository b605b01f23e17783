#include <cmath>

#include "mitsuba_parts.h"
#include "surface_model.h"

namespace ssphh::scene_io::mitsuba {
namespace {

// Texture coordinates of the file have v down the image, as Mitsuba's bitmaps.
void bitmap(XmlWriter& xml, std::string_view name, const std::string& file, const scene::TextureUse& use,
            bool raw) {
  xml.open("texture", {{"type", "bitmap"}, {"name", name}});
  string(xml, "filename", file);
  if (raw) boolean(xml, "raw", true);
  string(xml, "wrap_mode", name_of(use.wrap_u));
  string(xml, "filter_type", use.nearest ? "nearest" : "bilinear");
  const mat3 uv = uv_matrix(use);
  if (uv != mat3(1)) {
    // A transform of the plane: the translation stands in the fourth column.
    transform(xml, "to_uv",
              mat4(vec4(uv[0].x, uv[0].y, 0, 0), vec4(uv[1].x, uv[1].y, 0, 0), vec4(0, 0, 1, 0),
                   vec4(uv[2].x, uv[2].y, 0, 1)));
  }
  xml.close();
}

}  // namespace

void color(Export& e, std::string_view name, const vec3& factor, const scene::TextureUse& use) {
  if (use.texture < 0) {
    rgb(e.xml, name, factor);
  } else {
    bitmap(e.xml, name, e.textures.color(use.texture, factor), use, false);
  }
}

namespace {

void base_color(Export& e, std::string_view name, const scene::Material& m, bool vertex_colors) {
  if (vertex_colors && m.base_color_texture.texture < 0) {
    e.xml.open("texture", {{"type", "mesh_attribute"}, {"name", name}});
    string(e.xml, "name", "vertex_color");
    e.xml.close();
  } else {
    color(e, name, m.base_color, m.base_color_texture);
  }
}

void microfacets(XmlWriter& xml, const scene::Material& m) {
  string(xml, "distribution", m.specular_roughness < 0 ? "beckmann" : "ggx");
  number(xml, "alpha", roughness_alpha(m.specular_roughness));
}

void mixture(Export& e, const scene::Material& m, bool vertex_colors) {
  e.xml.open("bsdf", {{"type", "principled"}});
  base_color(e, "base_color", m, vertex_colors);
  const scene::TextureUse& use = m.metallic_roughness_texture;
  const float roughness = std::abs(m.specular_roughness);
  if (use.texture < 0) {
    number(e.xml, "roughness", roughness);
    number(e.xml, "metallic", m.metallic);
  } else {
    bitmap(e.xml, "roughness",
           e.textures.channel(use.texture, 1, fmt::format("times {}", roughness),
                              [&](float g) { return g * roughness; }),
           use, true);
    bitmap(e.xml, "metallic",
           e.textures.channel(use.texture, 2, fmt::format("times {}", m.metallic),
                              [&](float b) { return b * m.metallic; }),
           use, true);
  }
  number(e.xml, "eta", glm::max(1.001f, ior_of(normal_reflectance(m))));
  e.xml.close();
}

void reflection(Export& e, const scene::Material& m, bool vertex_colors) {
  switch (surface_kind(m)) {
    case SurfaceKind::black:
      e.xml.open("bsdf", {{"type", "diffuse"}});
      rgb(e.xml, "reflectance", vec3(0));
      e.xml.close();
      break;
    case SurfaceKind::lambert:
      e.xml.open("bsdf", {{"type", "diffuse"}});
      base_color(e, "reflectance", m, vertex_colors);
      e.xml.close();
      break;
    case SurfaceKind::dielectric: {
      if (m.metallic_roughness_texture.texture >= 0) {
        mixture(e, m, vertex_colors);
        break;
      }
      e.xml.open("bsdf", {{"type", "roughplastic"}});
      base_color(e, "diffuse_reflectance", m, vertex_colors);
      microfacets(e.xml, m);
      number(e.xml, "int_ior", ior_of(normal_reflectance(m)));
      number(e.xml, "ext_ior", 1);
      e.xml.close();
      break;
    }
    case SurfaceKind::metal:
      e.xml.open("bsdf", {{"type", "roughconductor"}});
      string(e.xml, "material", "none");
      base_color(e, "specular_reflectance", m, vertex_colors);
      microfacets(e.xml, m);
      e.xml.close();
      break;
    case SurfaceKind::mixture:
      mixture(e, m, vertex_colors);
      break;
  }
}

void note_reflection(const scene::Material& m, Differences& differences) {
  const SurfaceKind kind = surface_kind(m);
  const bool textured = m.metallic_roughness_texture.texture >= 0;
  const bool principled = kind == SurfaceKind::mixture || (kind == SurfaceKind::dielectric && textured);
  if (principled) {
    differences.add("becomes Mitsuba's principled BSDF (Disney's diffuse and Fresnel terms)", m.name);
  } else if (kind == SurfaceKind::dielectric) {
    differences.add("becomes Mitsuba's roughplastic (exact Fresnel term, its own balance of the two layers)",
                    m.name);
  } else if (kind == SurfaceKind::metal) {
    differences.add("becomes Mitsuba's roughconductor (the metal's colour at every angle)", m.name);
  }
  if (kind != SurfaceKind::lambert && kind != SurfaceKind::black && m.specular_roughness < 0)
    differences.add(principled ? "Blinn-Phong becomes GGX" : "Blinn-Phong becomes Beckmann", m.name);
}

}  // namespace

void write_bsdf(Export& e, const std::string& id, const scene::Material& m, bool vertex_colors) {
  const Coverage cover = coverage(e.scene, m, e.textures);
  const std::string name = m.name.empty() ? "(without a name)" : m.name;
  e.xml.comment(name);
  if (!cover.full()) {
    e.xml.open("bsdf", {{"type", "mask"}, {"id", id}});
    if (cover.file.empty()) {
      number(e.xml, "opacity", cover.value);
    } else {
      bitmap(e.xml, "opacity", cover.file, m.base_color_texture, true);
    }
    e.xml.open("bsdf", {{"type", "twosided"}});
  } else {
    e.xml.open("bsdf", {{"type", "twosided"}, {"id", id}});
  }
  const bool bumped = m.normal_texture.texture >= 0 && !m.unlit;
  if (bumped) {
    e.xml.open("bsdf", {{"type", "normalmap"}});
    bitmap(e.xml, "normalmap", e.textures.color(m.normal_texture.texture), m.normal_texture, true);
    if (m.normal_scale != 1) e.differences.add("normal maps at full strength", m.name);
  }
  reflection(e, m, vertex_colors);
  e.xml.close(1 + int{bumped} + int{!cover.full()});
  note_material(m, {.own_transform = true, .mirror = true, .nearest = true}, e.differences);
  note_reflection(m, e.differences);
}

}  // namespace ssphh::scene_io::mitsuba
