#include <cmath>
#include <set>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/scene_io/renderer_export.h>

#include "equal_area.h"
#include "export_steps.h"
#include "ply.h"
#include "printable.h"
#include "surface_model.h"

namespace ssphh::scene_io {
namespace pbrt {
namespace {

// pbrt-v4's scene format: https://pbrt.org/fileformat-v4. An RGB light of scale 1 gives a film of the default
// sensor its RGB back: pbrt divides a light's spectrum by the luminance of the colour space's white.
struct Export {
  const scene::Scene& scene;
  const std::filesystem::path& directory;
  TextureFiles textures;
  std::string text;
  Differences differences;
  std::vector<std::filesystem::path> files;
  std::set<std::string> defined;  ///< textures and materials
};

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

std::string number(const char* name, float value) {
  return fmt::format(" \"float {}\" [ {} ]", name, value);
}

std::string integer(const char* name, int value) {
  return fmt::format(" \"integer {}\" [ {} ]", name, value);
}

std::string boolean(const char* name, bool value) {
  return fmt::format(" \"bool {}\" [ {} ]", name, value);
}

std::string string(const char* name, const std::string& value) {
  return fmt::format(" \"string {}\" [ {} ]", name, quoted(value));
}

std::string rgb(const char* name, const vec3& c) {
  return fmt::format(" \"rgb {}\" [ {} {} {} ]", name, c.x, c.y, c.z);
}

std::string point(const char* name, const vec3& p) {
  return fmt::format(" \"point3 {}\" [ {} {} {} ]", name, p.x, p.y, p.z);
}

std::string texture(const char* name, const std::string& texture) {
  return fmt::format(" \"texture {}\" [ {} ]", name, quoted(texture));
}

void comment(Export& e, const std::string& name) {
  e.text += "# " + printable(name, 200) + "\n";  // no line ends in it
}

// Texture coordinates stand in the meshes with v up, as pbrt's images.
std::string image_texture(Export& e, const char* type, const std::string& file,
                          const scene::TextureUse& use) {
  const bool repeat = use.wrap_u != scene::Wrap::clamp;
  const std::string name =
      fmt::format("{} {} {}{}", file, type, repeat ? "repeat" : "clamp", use.nearest ? " point" : "");
  if (e.defined.insert("texture " + name).second) {
    e.text += fmt::format("Texture {} \"{}\" \"imagemap\"", quoted(name), type) + string("filename", file) +
              string("wrap", repeat ? "repeat" : "clamp") +
              string("filter", use.nearest ? "point" : "bilinear") + "\n";
  }
  return name;
}

std::string color(Export& e, const char* name, const vec3& factor, const scene::TextureUse& use) {
  if (use.texture < 0) return rgb(name, factor);
  return texture(name, image_texture(e, "spectrum", e.textures.color(use.texture, factor), use));
}

std::string roughness(Export& e, const scene::Material& m) {
  const float r = std::abs(m.specular_roughness);
  const scene::TextureUse& use = m.metallic_roughness_texture;
  // As α: pbrt would take a square root.
  std::string out = boolean("remaproughness", false);
  if (use.texture < 0) return out + number("roughness", roughness_alpha(r));
  const std::string file = e.textures.channel(use.texture, 1, fmt::format("alpha of {}", r),
                                              [&](float g) { return roughness_alpha(g * r); });
  return out + texture("roughness", image_texture(e, "float", file, use));
}

std::string normal_map(Export& e, const scene::Material& m) {
  if (m.normal_texture.texture < 0) return {};
  if (m.normal_scale != 1) e.differences.add("normal maps at full strength", m.name);
  return string("normalmap", e.textures.color(m.normal_texture.texture));
}

void define(Export& e, const std::string& name, const std::string& type, const std::string& parameters) {
  e.text += fmt::format("MakeNamedMaterial {}", quoted(name)) + string("type", type) + parameters + "\n";
}

void define_dielectric(Export& e, const std::string& name, const scene::Material& m) {
  const float f0 = normal_reflectance(m);
  const std::string base = color(e, "reflectance", m.base_color, m.base_color_texture);
  if (f0 == 0) {
    define(e, name, "diffuse", base + normal_map(e, m));
  } else {
    const std::string rough = roughness(e, m);
    define(e, name, "coateddiffuse", base + rough + number("eta", ior_of(f0)) + normal_map(e, m));
  }
}

void define_metal(Export& e, const std::string& name, const scene::Material& m) {
  const std::string base = color(e, "reflectance", m.base_color, m.base_color_texture);
  const std::string rough = roughness(e, m);
  define(e, name, "conductor", base + rough + normal_map(e, m));
}

void define_mixture(Export& e, const std::string& name, const scene::Material& m) {
  define_dielectric(e, name + "_dielectric", m);
  define_metal(e, name + "_metal", m);
  const scene::TextureUse& use = m.metallic_roughness_texture;
  std::string amount;
  if (use.texture < 0) {
    amount = number("amount", m.metallic);
  } else {
    const std::string file = e.textures.channel(use.texture, 2, fmt::format("times {}", m.metallic),
                                                [&](float b) { return b * m.metallic; });
    amount = texture("amount", image_texture(e, "float", file, use));
  }
  define(e, name, "mix",
         fmt::format(" \"string materials\" [ \"{0}_dielectric\" \"{0}_metal\" ]", name) + amount);
}

void note_reflection(const scene::Material& m, Differences& differences) {
  const SurfaceKind kind = surface_kind(m);
  if (kind == SurfaceKind::dielectric)
    differences.add("becomes pbrt's coateddiffuse (exact Fresnel term, light between the layers)", m.name);
  if (kind == SurfaceKind::metal)
    differences.add("becomes pbrt's conductor (exact Fresnel term of a metal of that colour)", m.name);
  if (kind == SurfaceKind::mixture)
    differences.add("becomes a mix of pbrt's coateddiffuse or diffuse and conductor", m.name);
  if (kind != SurfaceKind::lambert && kind != SurfaceKind::black && m.specular_roughness < 0)
    differences.add("Blinn-Phong becomes GGX", m.name);
  const bool gray = m.base_color.x == m.base_color.y && m.base_color.y == m.base_color.z;
  if (kind != SurfaceKind::black && (!gray || m.base_color_texture.texture >= 0))
    differences.add("colours are spectra: products of colours after several bounces are not RGB's", m.name);
}

void define_material(Export& e, const std::string& name, const scene::Material& m) {
  comment(e, m.name);
  switch (surface_kind(m)) {
    case SurfaceKind::black:
      define(e, name, "diffuse", rgb("reflectance", vec3(0)));
      break;
    case SurfaceKind::lambert:
    case SurfaceKind::dielectric:
      define_dielectric(e, name, m);
      break;
    case SurfaceKind::metal:
      define_metal(e, name, m);
      break;
    case SurfaceKind::mixture:
      define_mixture(e, name, m);
      break;
  }
  note_material(m, {}, e.differences);
  note_reflection(m, e.differences);
  // Normal maps repeat and are interpolated, whatever is asked.
  if (m.normal_texture.texture >= 0 &&
      (m.normal_texture.wrap_u != scene::Wrap::repeat || m.normal_texture.nearest))
    e.differences.add("normal maps repeat and are interpolated", m.name);
}

std::string area_light(Export& e, const scene::Material& m) {
  std::string light = "  AreaLightSource \"diffuse\"" + boolean("twosided", m.double_sided || m.unlit);
  const scene::TextureUse& use = glow_texture(m);
  if (use.texture < 0) return light + rgb("L", glow(m)) + "\n";
  if (use.wrap_u != scene::Wrap::clamp) e.differences.add("textures that glow are not repeated", m.name);
  return light + string("filename", e.textures.linear_color(use.texture, glow(m))) + "\n";
}

void write_mesh(Export& e, std::size_t index, const FlatMesh& mesh) {
  const scene::Material& m = material_of(e.scene, mesh);
  if (!mesh.mesh.colors.empty()) e.differences.add("vertex colours are left out", m.name);
  std::vector<vec2> uv = texture_coordinates(mesh.mesh, leading_texture(m));
  for (vec2& t : uv) t.y = 1 - t.y;
  const std::string name = fmt::format("mesh{}.ply", index);
  write_file(e.directory / name, encode_ply(mesh.mesh, uv));
  e.files.push_back(e.directory / name);

  const Coverage cover = coverage(e.scene, m, e.textures);
  std::string alpha;
  if (!cover.file.empty()) {
    alpha = texture("alpha", image_texture(e, "float", cover.file, m.base_color_texture));
  } else if (!cover.full()) {
    alpha = number("alpha", cover.value);
  }
  comment(e, mesh.name);
  e.text += "AttributeBegin\n  NamedMaterial " + quoted(material_id(e.scene, mesh)) + "\n";
  const bool there = !cover.file.empty() || cover.value > 0;  // pbrt's lights glow where nothing covers
  if (m.emissive() && there) e.text += area_light(e, m);
  e.text += "  Shape \"plymesh\"" + string("filename", name) + alpha + "\nAttributeEnd\n";
}

void write_light(Export& e, const FlatLight& flat) {
  const scene::Light& light = *flat.light;
  const vec3& strength = flat.strength;
  const vec3 aim = flat.position + flat.direction;
  comment(e, light.name);
  note_light(light, e.differences);
  switch (light.type) {
    case scene::LightType::sphl:
    case scene::LightType::point:
      e.text += "LightSource \"point\"" + rgb("I", strength) + point("from", flat.position) + "\n";
      break;
    case scene::LightType::spot:
      e.text += "LightSource \"spot\"" + rgb("I", strength) + point("from", flat.position) +
                point("to", aim) + number("coneangle", glm::degrees(light.outer_cone)) +
                number("conedeltaangle", glm::degrees(light.outer_cone - light.inner_cone)) + "\n";
      e.differences.add(
          "spots fade with a smoothstep of the cosine between the cones (here: with the square of a ramp)",
          light.name);
      break;
    case scene::LightType::directional:
      e.text += "LightSource \"distant\"" + rgb("L", strength) + point("from", vec3(0)) +
                point("to", flat.direction) + "\n";
      if (light.angular_radius > 0)
        e.differences.add("suns have no size: hard shadows, and unseen", light.name);
      break;
    case scene::LightType::sphere:
      e.text += fmt::format("AttributeBegin\n  Translate {} {} {}\n", flat.position.x, flat.position.y,
                            flat.position.z) +
                "  Material \"diffuse\"" + rgb("reflectance", vec3(0)) + "\n  AreaLightSource \"diffuse\"" +
                rgb("L", strength) + "\n  Shape \"sphere\"" + number("radius", light.radius) +
                "\nAttributeEnd\n";
      e.differences.add("sphere lights block other light", light.name);
      break;
    case scene::LightType::rectangle:
    case scene::LightType::disc:
      break;  // meshes by now
  }
}

void write_environment(Export& e, const scene::Environment& environment) {
  if (environment.equirect.empty()) {
    e.text += "LightSource \"infinite\"" + rgb("L", environment.color) + "\n";
    return;
  }
  e.text += "LightSource \"infinite\"" +
            string("filename", e.textures.image("environment.exr", equal_area_image(environment))) + "\n";
  e.differences.add("environment images are resampled to pbrt's equal-area square, without interpolation",
                    environment.name);
}

std::string camera(const ExportSettings& settings, const scene::CameraPose& pose) {
  const scene::Camera& c = pose.camera;
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  // Looks along +z there.
  const mat4 view = mat4(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, -1, 0), vec4(0, 0, 0, 1)) *
                    glm::inverse(pose.world);
  std::string out = "Transform [";
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) out += fmt::format(" {}", view[column][row]);
  }
  out += " ]\n";
  const float half = c.orthographic ? 0.5f * c.yheight : 1.0f;
  out += c.orthographic ? "Camera \"orthographic\""
                        : "Camera \"perspective\"" + number("fov", glm::degrees(c.yfov));
  return out +
         fmt::format(" \"float screenwindow\" [ {} {} {} {} ]\n", -aspect * half, aspect * half, -half, half);
}

// What stands before the world: camera, film and how the picture is made.
std::string picture_text(const ExportSettings& settings, const scene::CameraPose& pose,
                         const std::string& picture) {
  return camera(settings, pose) + "Film \"rgb\"" + integer("xresolution", settings.width) +
         integer("yresolution", settings.height) + string("filename", picture) + boolean("savefp16", false) +
         "\nPixelFilter \"box\"" + number("xradius", 0.5f) + number("yradius", 0.5f) +
         "\nSampler \"independent\"" + integer("pixelsamples", settings.spp) + "\nIntegrator \"path\"" +
         integer("maxdepth", settings.max_depth) + "\nWorldBegin\n";
}

// Faces of a cube map share the world, a file of its own.
void write_views(Export& e, const ExportSettings& settings) {
  if (!settings.cube_at)
    return write_file(e.files.front(), picture_text(settings, settings.camera, "picture.exr") + e.text);
  std::vector<std::filesystem::path> files;
  for (const scene::CameraPose& pose : cube_cameras(*settings.cube_at)) {
    const std::string name = fmt::format("face{}", files.size());
    files.push_back(e.directory / (name + ".pbrt"));
    write_file(files.back(), picture_text(settings, pose, name + ".exr") + "Include \"world.pbrt\"\n");
  }
  e.files.front() = e.directory / "world.pbrt";
  write_file(e.files.front(), e.text);
  e.files.insert(e.files.begin(), files.begin(), files.end());
}

}  // namespace
}  // namespace pbrt

ExportReport export_pbrt(const scene::Scene& given, const ExportSettings& settings,
                         const std::filesystem::path& directory) {
  using namespace pbrt;
  const scene::Scene scene = begin_export(given, settings, directory);
  const FlatScene flat = flatten(scene, settings.time);
  const std::filesystem::path file = directory / "scene.pbrt";
  Export e{scene, directory, TextureFiles(scene, directory), {}, {}, {file}, {}};
  note_area_lamps(given, e.differences);
  for (const FlatLight& light : flat.lights) write_light(e, light);
  if (scene.environment) write_environment(e, *scene.environment);
  for (const FlatMesh& mesh : flat.meshes) {
    const std::string id = material_id(scene, mesh);
    if (e.defined.insert("material " + id).second) define_material(e, id, material_of(scene, mesh));
  }
  for (std::size_t i = 0; i < flat.meshes.size(); ++i) write_mesh(e, i, flat.meshes[i]);
  note_shown_emitters(scene, flat, settings, e.differences);
  write_views(e, settings);

  const std::string command =
      settings.cube_at ? for_each_face("pbrt --outfile face$f.exr " + (directory / "face$f.pbrt").string())
                       : fmt::format("pbrt --outfile picture.exr {}", file.string());
  return end_export(std::move(e.files), e.textures, e.differences, command);
}

}  // namespace ssphh::scene_io
