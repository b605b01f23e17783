#include <set>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/json.h>
#include <ssphh/image/io.h>
#include <ssphh/scene_io/renderer_export.h>

#include "cycles_scripts.h"
#include "differences.h"
#include "export_steps.h"
#include "flat_scene.h"
#include "surface_model.h"

namespace ssphh::scene_io {
namespace {

json::Value array(const vec3& v) {
  return {v.x, v.y, v.z};
}

// Rows of the matrix.
json::Value array(const mat4& m) {
  json::Value rows = json::Value::array();
  for (int r = 0; r < 4; ++r) rows.push_back({m[0][r], m[1][r], m[2][r], m[3][r]});
  return rows;
}

template <class T>
std::size_t append(std::vector<std::byte>& binary, const std::vector<T>& values) {
  const std::size_t offset = binary.size();
  const auto bytes = std::as_bytes(std::span(values));
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  return offset;
}

json::Value mesh_json(const FlatMesh& flat, std::vector<std::byte>& binary) {
  const scene::Mesh& mesh = flat.mesh;
  json::Value json = {{"name", flat.name},
                      {"material", flat.material},
                      {"vertices", mesh.positions.size()},
                      {"triangles", mesh.triangles.size()},
                      {"positions", append(binary, mesh.positions)},
                      {"indices", append(binary, mesh.triangles)}};
  if (!mesh.normals.empty()) json["normals"] = append(binary, mesh.normals);
  for (int set = 0; set < 2; ++set) {
    const auto& uv = mesh.uvs[set];
    if (!uv.empty()) json[fmt::format("uv{}", set)] = append(binary, uv);
  }
  if (!mesh.colors.empty()) json["colors"] = append(binary, mesh.colors);
  return json;
}

json::Value texture_json(const scene::TextureUse& use) {
  if (use.texture < 0) return nullptr;
  return {{"texture", use.texture},
          {"uv_set", use.uv_set},
          {"offset", {use.offset.x, use.offset.y}},
          {"scale", {use.scale.x, use.scale.y}},
          {"rotation", use.rotation},
          {"wrap", {name_of(use.wrap_u), name_of(use.wrap_v)}},
          {"nearest", use.nearest}};
}

json::Value material_json(const scene::Material& m) {
  const float f0 = std::pow((m.ior - 1) / (m.ior + 1), 2.0f) * m.specular;
  return {{"name", m.name},
          {"base_color", array(m.base_color)},
          {"alpha", m.alpha},
          {"metallic", m.metallic},
          {"diffuse_roughness", m.diffuse_roughness},
          {"specular_roughness", m.specular_roughness},
          {"f0", f0},
          {"ior", m.ior},
          {"specular", m.specular},
          {"transmission", m.is_glass() ? m.transmission : 0},
          {"sheet", !(m.thickness > 0)},
          {"attenuation_color", array(m.attenuation_color)},
          {"attenuation_distance", m.attenuation_distance},
          {"emission", array(m.emission)},
          {"unlit", m.unlit},
          {"double_sided", m.double_sided},
          {"alpha_mode", name_of(m.alpha_mode)},
          {"alpha_cutoff", m.alpha_cutoff},
          {"normal_scale", m.normal_scale},
          {"base_color_texture", texture_json(m.base_color_texture)},
          {"metallic_roughness_texture", texture_json(m.metallic_roughness_texture)},
          {"emission_texture", texture_json(m.emission_texture)},
          {"normal_texture", texture_json(m.normal_texture)},
          {"transmission_texture", texture_json(m.transmission_texture)}};
}

void note_material(const scene::Material& m, Differences& differences) {
  const bool layered = m.metallic > 0 || m.specular > 0;
  if (layered && !m.unlit) {
    differences.add(
        "specular reflection is a lobe of Cycles' own with the same albedo at every view angle; the diffuse "
        "layer under it does not depend on the light's angle",
        m.name);
  }
  if (layered && m.specular_roughness < 0) {
    differences.add("Blinn-Phong becomes Beckmann, its Fresnel term that of the view angle", m.name);
  }
  if (m.is_glass() && m.thickness == 0) {
    differences.add(
        "sheets of glass add their reflections up for unpolarised light, rough ones show what is behind "
        "them sharply",
        m.name);
  }
  if (m.diffuse_roughness > 0) differences.add("Disney's diffuse model becomes Lambert's", m.name);
  if (m.normal_texture.texture >= 0) {
    differences.add("normal maps use tangents of the other renderer's own", m.name);
  }
}

json::Value light_json(const FlatLight& flat) {
  const scene::Light& l = *flat.light;
  const bool shaped =
      l.type == scene::LightType::sphl || (l.has_profile() && l.type == scene::LightType::point);
  return {{"name", l.name},
          {"type", shaped ? "point" : name_of(l.type)},
          {"position", array(flat.position)},
          {"direction", array(flat.direction)},
          {"world", array(flat.world)},
          {"color", array(shaped ? flat.strength : l.color)},
          {"intensity", shaped ? 1 : l.intensity},
          {"radius", shaped ? 0 : l.radius},
          {"angular_radius", l.angular_radius},
          {"cos_inner", std::cos(l.inner_cone)},
          {"cos_outer", std::cos(l.outer_cone)}};
}

json::Value camera_json(const scene::CameraPose& pose) {
  return {{"world", array(pose.world)},
          {"orthographic", pose.camera.orthographic},
          {"yfov", pose.camera.yfov},
          {"yheight", pose.camera.yheight}};
}

std::string texture_file(const scene::Texture& texture, std::size_t index) {
  std::string name = fmt::format("texture{}", index);
  for (const char c : texture.name) {
    if (std::isalnum(static_cast<unsigned char>(c)) && name.size() < 60) name += c;
  }
  return name + ".png";
}

}  // namespace

ExportReport export_cycles(const scene::Scene& given, const ExportSettings& settings,
                           const std::filesystem::path& directory) {
  const scene::Scene scene = begin_export(given, settings, directory);
  const FlatScene flat = flatten(scene, settings.time);
  ExportReport report;
  Differences differences;
  note_area_lamps(given, differences);
  report.files.push_back(directory / "render.py");

  json::Value json = {{"format", "ssphh cycles scene"},
                      {"version", 1},
                      {"name", scene.name},
                      {"width", settings.width},
                      {"height", settings.height},
                      {"max_depth", settings.max_depth},
                      {"spp", settings.spp},
                      {"camera", camera_json(settings.camera)}};
  json["textures"] = json::Value::array();
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const scene::Texture& texture = scene.textures[i];
    const std::string name = texture_file(texture, i);
    write_file(directory / name,
               image::encode_png(image::Rgba8{texture.width, texture.height, texture.rgba}));
    report.files.push_back(directory / name);
    json["textures"].push_back({{"file", name}, {"width", texture.width}, {"height", texture.height}});
  }
  json["materials"] = json::Value::array();
  for (const scene::Material& material : scene.materials)
    json["materials"].push_back(material_json(material));
  json["default_material"] = material_json({});

  std::vector<std::byte> binary;
  json["meshes"] = json::Value::array();
  std::set<int> used;
  for (const FlatMesh& mesh : flat.meshes) {
    json["meshes"].push_back(mesh_json(mesh, binary));
    if (used.insert(mesh.material).second) note_material(material_of(scene, mesh), differences);
  }
  json["lights"] = json::Value::array();
  for (const FlatLight& light : flat.lights) {
    json["lights"].push_back(light_json(light));
    note_light(*light.light, differences);
  }
  if (scene.environment) {
    const scene::Environment& e = *scene.environment;
    json["environment"] = {{"color", array(e.color)}, {"rotation", e.rotation}};
    if (!e.equirect.empty()) {
      image::write_image(directory / "environment.exr", e.equirect);
      report.files.push_back(directory / "environment.exr");
      json["environment"]["file"] = "environment.exr";
    }
  }
  write_file(directory / "scene.bin", binary);
  write_file(directory / "scene.json", json::print(json, 1));
  for (const CyclesScript& script : cycles_scripts()) {
    write_file(directory / script.name, script.text);
    if (script.name != std::string_view("render.py")) report.files.push_back(directory / script.name);
  }
  report.files.push_back(directory / "scene.json");
  report.files.push_back(directory / "scene.bin");
  std::string output = "--output picture.exr";
  if (settings.cube_at) {
    json::Value cameras = json::Value::array();
    for (const scene::CameraPose& pose : cube_cameras(*settings.cube_at))
      cameras.push_back(array(pose.world));
    write_file(directory / "cube.json", json::print(cameras));
    report.files.push_back(directory / "cube.json");
    output = fmt::format("--cube {} --output cube", (directory / "cube.json").string());
  }
  report.command = fmt::format("blender --background --factory-startup --python {} -- {}",
                               (directory / "render.py").string(), output);
  report.differences = differences.lines();
  return report;
}

}  // namespace ssphh::scene_io
