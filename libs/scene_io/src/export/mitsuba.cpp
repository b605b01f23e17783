#include <set>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/core/file.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/scene_io/renderer_export.h>

#include "export_steps.h"
#include "mitsuba_parts.h"
#include "ply.h"
#include "surface_model.h"

namespace ssphh::scene_io {
namespace mitsuba {
namespace {

std::string bsdf_id(const scene::Scene& scene, const FlatMesh& mesh) {
  return (mesh.mesh.colors.empty() ? "" : "colored_") + material_id(scene, mesh);
}

void area_light(Export& e, const scene::Material& m) {
  e.xml.open("emitter", {{"type", "area"}});
  color(e, "radiance", glow(m), glow_texture(m));
  e.xml.close();
  if (m.double_sided || m.unlit) e.differences.add("glows on the front alone", m.name);
  if (m.alpha_mode != scene::AlphaMode::opaque) e.differences.add("glows where it is cut out, too", m.name);
}

void write_mesh(Export& e, std::size_t index, const FlatMesh& mesh) {
  const scene::Material& m = material_of(e.scene, mesh);
  std::vector<vec3> colors;
  for (const vec4& c : mesh.mesh.colors) colors.push_back(m.base_color * vec3(c));
  if (!colors.empty()) {
    if (m.base_color_texture.texture >= 0)
      e.differences.add("vertex colours on textures are left out", m.name);
    for (const vec4& c : mesh.mesh.colors) {
      if (c.w == 1) continue;
      e.differences.add("the coverage of vertices is left out", m.name);
      break;
    }
  }
  // Each texture has its own transform; the file has the set they share.
  scene::TextureUse set;
  set.texture = leading_texture(m).texture, set.uv_set = leading_texture(m).uv_set;
  const std::string name = fmt::format("mesh{}.ply", index);
  write_file(e.directory / name, encode_ply(mesh.mesh, texture_coordinates(mesh.mesh, set), colors));
  e.files.push_back(e.directory / name);

  e.xml.comment(mesh.name);
  e.xml.open("shape", {{"type", "ply"}, {"id", identifier("mesh", index, mesh.name)}});
  string(e.xml, "filename", name);
  // Mitsuba makes smooth normals for meshes that have none.
  if (mesh.mesh.normals.empty()) boolean(e.xml, "face_normals", true);
  e.xml.empty("ref", {{"id", bsdf_id(e.scene, mesh)}});
  if (m.emissive()) area_light(e, m);
  e.xml.close();
}

void write_light(Export& e, const FlatLight& flat) {
  const scene::Light& light = *flat.light;
  const vec3& strength = flat.strength;
  e.xml.comment(light.name);
  note_light(light, e.differences);
  switch (light.type) {
    case scene::LightType::sphl:
    case scene::LightType::point:
      e.xml.open("emitter", {{"type", "point"}});
      point(e.xml, "position", flat.position);
      rgb(e.xml, "intensity", strength);
      break;
    case scene::LightType::spot: {
      e.xml.open("emitter", {{"type", "spot"}});
      // Shines along its +z.
      const Frame frame = Frame::around(flat.direction);
      transform(e.xml, "to_world",
                mat4(vec4(frame.x, 0), vec4(frame.y, 0), vec4(frame.z, 0), vec4(flat.position, 1)));
      rgb(e.xml, "intensity", strength);
      number(e.xml, "cutoff_angle", glm::degrees(light.outer_cone));
      number(e.xml, "beam_width", glm::degrees(light.inner_cone));
      e.differences.add(
          "spots fade linearly in the angle between the cones (here: with the square of a ramp in the "
          "cosine)",
          light.name);
      break;
    }
    case scene::LightType::directional:
      e.xml.open("emitter", {{"type", "directional"}});
      e.xml.empty("vector", {{"name", "direction"},
                             {"x", fmt::format("{}", flat.direction.x)},
                             {"y", fmt::format("{}", flat.direction.y)},
                             {"z", fmt::format("{}", flat.direction.z)}});
      rgb(e.xml, "irradiance", strength);
      if (light.angular_radius > 0)
        e.differences.add("suns have no size: hard shadows, and unseen", light.name);
      break;
    case scene::LightType::sphere:
      e.xml.open("shape", {{"type", "sphere"}});
      point(e.xml, "center", flat.position);
      number(e.xml, "radius", light.radius);
      e.xml.open("bsdf", {{"type", "diffuse"}});
      rgb(e.xml, "reflectance", vec3(0));
      e.xml.close();
      e.xml.open("emitter", {{"type", "area"}});
      rgb(e.xml, "radiance", strength);
      e.xml.close();
      e.differences.add("sphere lights block other light", light.name);
      break;
    case scene::LightType::rectangle:
    case scene::LightType::disc:
      break;  // meshes by now
  }
  e.xml.close();
}

// Mitsuba's rows reach from pole to pole, ours are centres of bands. Twice as many rows and one have all of
// our centres and the places between them: the same interpolation.
image::Image with_rows_at_poles(const image::Image& equirect, const vec3& factor) {
  image::Image result(equirect.width, 2 * equirect.height + 1);
  for (int y = 0; y < result.height; ++y) {
    const float v = static_cast<float>(y) / static_cast<float>(result.height - 1);
    for (int x = 0; x < result.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(result.width);
      result.set_rgb(x, y, factor * image::sample_equirect(equirect, image::equirect_direction(u, v)));
    }
  }
  return result;
}

void write_environment(Export& e, const scene::Environment& environment) {
  if (environment.equirect.empty()) {
    e.xml.open("emitter", {{"type", "constant"}});
    rgb(e.xml, "radiance", environment.color);
  } else {
    e.xml.open("emitter", {{"type", "envmap"}});
    string(e.xml, "filename",
           e.textures.image("environment.exr", with_rows_at_poles(environment.equirect, environment.color)));
    // Its image's left edge looks to -z, ours to -x.
    transform(e.xml, "to_world", glm::rotate(mat4(1), environment.rotation + pi / 2, vec3(0, 1, 0)));
  }
  e.xml.close();
}

void write_camera(Export& e, const scene::CameraPose& pose) {
  const scene::Camera& camera = pose.camera;
  // Looks along +z with x to the left.
  mat4 world = pose.world * mat4(vec4(-1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, -1, 0), vec4(0, 0, 0, 1));
  e.xml.open("sensor", {{"type", camera.orthographic ? "orthographic" : "perspective"}});
  if (camera.orthographic) {
    // Sees [-1, 1] across.
    const float half =
        0.5f * camera.yheight * static_cast<float>(e.settings.width) / static_cast<float>(e.settings.height);
    world = glm::scale(world, vec3(half, half, 1));
  } else {
    string(e.xml, "fov_axis", "y");
    number(e.xml, "fov", glm::degrees(camera.yfov));
  }
  number(e.xml, "near_clip", 1e-4f);
  number(e.xml, "far_clip", 1e6f);
  transform(e.xml, "to_world", world);
  e.xml.open("sampler", {{"type", "independent"}});
  integer(e.xml, "sample_count", e.settings.spp);
  e.xml.close();
  e.xml.open("film", {{"type", "hdrfilm"}});
  integer(e.xml, "width", e.settings.width);
  integer(e.xml, "height", e.settings.height);
  string(e.xml, "pixel_format", "rgb");
  string(e.xml, "component_format", "float32");
  e.xml.empty("rfilter", {{"type", "box"}});
  e.xml.close(2);
}

bool cut_out(const Export& e, const FlatScene& flat) {
  for (const FlatMesh& mesh : flat.meshes) {
    if (material_of(e.scene, mesh).alpha_mode != scene::AlphaMode::opaque) return true;
  }
  return false;
}

}  // namespace
}  // namespace mitsuba

ExportReport export_mitsuba(const scene::Scene& given, const ExportSettings& settings,
                            const std::filesystem::path& directory) {
  using namespace mitsuba;
  const scene::Scene scene = begin_export(given, settings, directory);
  const FlatScene flat = flatten(scene, settings.time);
  const std::filesystem::path file = directory / "scene.xml";
  Export e{scene, settings, directory, TextureFiles(scene, directory), XmlWriter(), {}, {file}};
  note_area_lamps(given, e.differences);
  e.xml.open("scene", {{"version", "3.0.0"}});
  // What covers in part lets through light of lamps in volpath alone.
  e.xml.open("integrator", {{"type", cut_out(e, flat) ? "volpath" : "path"}});
  integer(e.xml, "max_depth", settings.max_depth + 1);  // Mitsuba counts segments
  if (!settings.shows_emitters) boolean(e.xml, "hide_emitters", true);
  e.xml.close();
  for (const scene::CameraPose& pose : cameras_of(settings)) write_camera(e, pose);
  std::set<std::string> written;
  for (const FlatMesh& mesh : flat.meshes) {
    const std::string id = bsdf_id(scene, mesh);
    if (written.insert(id).second) write_bsdf(e, id, material_of(scene, mesh), !mesh.mesh.colors.empty());
  }
  for (std::size_t i = 0; i < flat.meshes.size(); ++i) write_mesh(e, i, flat.meshes[i]);
  for (const FlatLight& light : flat.lights) write_light(e, light);
  if (scene.environment) write_environment(e, *scene.environment);
  e.xml.close();
  write_file(file, e.xml.str());

  const std::string command =
      settings.cube_at
          ? for_each_face(fmt::format("mitsuba -m scalar_rgb -s $f -o face$f.exr {}", file.string()))
          : fmt::format("mitsuba -m scalar_rgb -o picture.exr {}", file.string());
  return end_export(std::move(e.files), e.textures, e.differences, command);
}

}  // namespace ssphh::scene_io
