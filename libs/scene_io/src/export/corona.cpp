#include <cmath>
#include <set>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene_io/renderer_export.h>

#include "corona_obj.h"
#include "export_steps.h"
#include "surface_model.h"
#include "xml_writer.h"

namespace ssphh::scene_io {
namespace corona {
namespace {

// Corona Standalone: https://wiki.corona-renderer.com/standalone (scn, mtl, mtl-maps, obj, conf). All that
// is not documented there is left alone: every lamp becomes glowing geometry, whose meaning is plain.
struct Export {
  const scene::Scene& scene;
  const ExportSettings& settings;
  const std::filesystem::path& directory;
  TextureFiles textures;
  XmlWriter scn, mtl;
  Differences differences;
  std::vector<std::filesystem::path> files;
  std::size_t meshes = 0;
};

constexpr float point_light_radius = 0.01f;  // metres
constexpr float spot_radius = 0.001f;        // of the sphere that glows, in a shell of
constexpr float spot_shell_radius = 0.02f;
constexpr float sun_angular_radius = 0.00465f;  // radians, of suns without a size
constexpr float distance_of_sky = 1000;         // in radii of the scene

std::string numbers(const vec3& v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

// Linear OpenEXR throughout: the format knows a power as transfer curve, not sRGB's.
void map(XmlWriter& xml, const std::string& file, const scene::TextureUse& use) {
  const char* wrap = use.wrap_u == scene::Wrap::clamp ? "clamp" : "repeat";
  xml.open("map", {{"class", "Texture"}});
  xml.text("image", file);
  xml.text("gamma", "1");
  xml.open("uvMap");
  xml.text("mode", "uvw");
  xml.text("wrapModeU", wrap);
  xml.text("wrapModeV", wrap);
  xml.close(2);
}

void color(Export& e, const char* element, const vec3& factor, const scene::TextureUse& use) {
  if (use.texture < 0) {
    e.mtl.text(element, numbers(factor));
    return;
  }
  e.mtl.open(element);
  map(e.mtl, e.textures.linear_color(use.texture, factor), use);
  e.mtl.close();
}

void reflect(Export& e, const scene::Material& m, float ior) {
  e.mtl.open("reflect");
  const SurfaceKind kind = surface_kind(m);
  if (kind == SurfaceKind::dielectric) {
    e.mtl.text("color", "1 1 1");
  } else {
    color(e, "color", m.base_color, m.base_color_texture);
  }
  e.mtl.text("ior", fmt::format("{}", ior));
  const scene::TextureUse& use = m.metallic_roughness_texture;
  const float r = std::abs(m.specular_roughness);
  if (use.texture < 0) {
    e.mtl.text("glossiness", fmt::format("{}", 1 - r));
  } else {
    e.mtl.open("glossiness");
    map(e.mtl,
        e.textures.channel(use.texture, 1, fmt::format("glossiness of {}", r),
                           [&](float g) { return 1 - g * r; }),
        use);
    e.mtl.close();
  }
  e.mtl.close();
}

void write_material(Export& e, const std::string& id, const scene::Material& m) {
  constexpr float metal_ior = 999;  // as the paper's authors wrote metals: the colour at every angle
  const SurfaceKind kind = surface_kind(m);
  e.mtl.comment(m.name);
  e.mtl.open("materialDefinition", {{"name", id}});
  e.mtl.open("material", {{"class", "Native"}});
  // Of a mixture, the half that there is more of.
  const bool metal = kind == SurfaceKind::metal || (kind == SurfaceKind::mixture && m.metallic > 0.5f &&
                                                    m.metallic_roughness_texture.texture < 0);
  if (metal || kind == SurfaceKind::black) {
    e.mtl.text("diffuse", "0 0 0");
  } else {
    color(e, "diffuse", m.base_color, m.base_color_texture);
  }
  if (metal) {
    reflect(e, m, metal_ior);
  } else if (kind == SurfaceKind::dielectric) {
    reflect(e, m, ior_of(normal_reflectance(m)));
  }
  if (m.emissive()) {
    e.mtl.open("emission");
    color(e, "color", glow(m), glow_texture(m));
    e.mtl.close();
    e.differences.add("which side of a surface glows is Corona's choice", m.name);
  }
  e.mtl.close(2);

  note_material(m, {}, e.differences);
  if (kind == SurfaceKind::mixture)
    e.differences.add(metal ? "partial metals become metals" : "partial metals become Lambert's", m.name);
  if (kind == SurfaceKind::dielectric || metal)
    e.differences.add("specular reflection is Corona's own lobe, glossiness 1 - roughness", m.name);
  if (m.normal_texture.texture >= 0) e.differences.add("normal maps are left out", m.name);
  if (m.alpha_mode != scene::AlphaMode::opaque)
    e.differences.add("cut-outs are left out: all of the surface is there", m.name);
}

void write_mesh(Export& e, const std::string& name, const std::string& material, const scene::Mesh& mesh,
                std::vector<vec2> uv) {
  for (vec2& t : uv) t.y = 1 - t.y;
  const std::string file = fmt::format("mesh{}.obj", e.meshes++);
  write_file(e.directory / file, encode_corona_obj(mesh, uv));
  e.files.push_back(e.directory / file);
  e.scn.comment(name);
  e.scn.open("geometryGroup");
  e.scn.open("instance");
  e.scn.text("material", material, {{"class", "Reference"}});
  e.scn.text("transform", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  e.scn.close();
  e.scn.text("object", file, {{"class", "file"}});
  e.scn.close();
}

// Of a material that reflects nothing; its colour and three ends are still to come.
void open_emission(Export& e, const std::string& id) {
  e.mtl.open("materialDefinition", {{"name", id}});
  e.mtl.open("material", {{"class", "Native"}});
  e.mtl.text("diffuse", "0 0 0");
  e.mtl.open("emission");
}

void write_emitter(Export& e, const std::string& id, const vec3& radiance) {
  open_emission(e, id);
  e.mtl.text("color", numbers(radiance));
  e.mtl.close(3);
}

// Scaled so that its mean projected area is the sphere's: a quarter of the surface (Cauchy).
scene::Mesh sphere_around(const vec3& center, float radius) {
  const scene::Mesh unit = scene::make_sphere(1, 48, 24);
  double area = 0;
  for (const uvec3& t : unit.triangles) {
    const vec3 a = unit.positions[t.x];
    area +=
        0.5 * static_cast<double>(glm::length(glm::cross(unit.positions[t.y] - a, unit.positions[t.z] - a)));
  }
  const float grow = radius * static_cast<float>(std::sqrt(4 * pi_d / area));
  return scene::transformed(unit, glm::scale(glm::translate(mat4(1), center), vec3(grow)));
}

// Regular polygon of the disc's area, its front toward `normal`.
scene::Mesh disc_around(const vec3& center, const vec3& normal, float radius) {
  constexpr unsigned corners = 64;
  const float circumradius = radius * std::sqrt(2 * pi / (corners * std::sin(2 * pi / corners)));
  const Frame frame = Frame::around(normal);
  scene::Mesh mesh;
  for (unsigned i = 0; i < corners; ++i) {
    const float phi = 2 * pi * static_cast<float>(i) / corners;
    mesh.positions.push_back(center +
                             frame.to_world(circumradius * vec3(std::cos(phi), std::sin(phi), 0.0f)));
    if (i >= 2) mesh.triangles.emplace_back(0, i - 1, i);
  }
  return mesh;
}

// Sphere with a round hole of half angle acos(cos_hole) toward `axis`.
scene::Mesh shell_around(const vec3& center, float radius, const vec3& axis, float cos_hole) {
  constexpr unsigned segments = 64, rings = 16;
  const Frame frame = Frame::around(axis);
  const float edge = std::acos(cos_hole);
  scene::Mesh mesh;
  for (unsigned y = 0; y <= rings; ++y) {
    const float theta = edge + (pi - edge) * static_cast<float>(y) / rings;
    for (unsigned x = 0; x < segments; ++x) {
      const float phi = 2 * pi * static_cast<float>(x) / segments;
      const vec3 direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      mesh.positions.push_back(center + radius * frame.to_world(direction));
      if (y == rings) continue;
      const unsigned a = y * segments + x, b = y * segments + (x + 1) % segments;
      if (y + 1 < rings) mesh.triangles.emplace_back(a, a + segments, b + segments);
      mesh.triangles.emplace_back(a, y + 1 < rings ? b + segments : a + segments, b);
    }
  }
  return mesh;
}

scene::Bounds bounds_of(const FlatScene& flat) {
  scene::Bounds bounds;
  for (const FlatMesh& mesh : flat.meshes)
    for (const vec3& p : mesh.mesh.positions) bounds.add(p);
  if (bounds.empty()) bounds.add(vec3(0));
  return bounds;
}

void write_light(Export& e, std::size_t index, const FlatLight& flat, const scene::Bounds& bounds) {
  const scene::Light& light = *flat.light;
  const std::string id = identifier("light", index, light.name);
  const vec3& strength = flat.strength;
  note_light(light, e.differences);
  switch (light.type) {
    case scene::LightType::sphl:
    case scene::LightType::point:
      write_emitter(e, id, strength / (pi * point_light_radius * point_light_radius));
      write_mesh(e, light.name, id, sphere_around(flat.position, point_light_radius), {});
      e.differences.add("point lights become spheres of 1 cm that block other light", light.name);
      break;
    case scene::LightType::spot: {
      // The hole that lets the cone's power through: the squared ramp's mean is a third.
      const float inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone);
      write_emitter(e, id, strength / (pi * spot_radius * spot_radius));
      write_mesh(e, light.name, id, sphere_around(flat.position, spot_radius), {});
      write_emitter(e, id + "_shell", vec3(0));
      write_mesh(e, light.name, id + "_shell",
                 shell_around(flat.position, spot_shell_radius, flat.direction, inner - (inner - outer) / 3),
                 {});
      e.differences.add(
          "spots become a sphere of 1 mm in a black shell of 2 cm with a hole: as much light, a hard edge",
          light.name);
      break;
    }
    case scene::LightType::directional: {
      const float angle = light.angular_radius > 0 ? light.angular_radius : sun_angular_radius;
      if (light.angular_radius == 0)
        e.differences.add("directional lights get the sun's size, 0.53 degrees across", light.name);
      e.differences.add("suns stand at 500 radii of the scene, not infinitely far", light.name);
      const float distance = 0.5f * distance_of_sky * glm::max(bounds.radius(), 1e-3f);
      write_emitter(e, id, strength / (pi * std::sin(angle) * std::sin(angle)));
      write_mesh(e, light.name, id,
                 disc_around(bounds.center() - distance * flat.direction, flat.direction,
                             distance * std::tan(angle)),
                 {});
      break;
    }
    case scene::LightType::sphere:
      write_emitter(e, id, strength);
      write_mesh(e, light.name, id, sphere_around(flat.position, light.radius), {});
      e.differences.add("sphere lights block other light", light.name);
      break;
    case scene::LightType::rectangle:
    case scene::LightType::disc:
      break;  // meshes by now
  }
}

// The inside of a large sphere with the image on it: no convention of the format's comes in.
void write_sky(Export& e, const scene::Environment& environment, const scene::Bounds& bounds) {
  constexpr unsigned columns = 128, rows = 64;
  const float distance = distance_of_sky * glm::max(bounds.radius(), 1e-3f);
  const mat3 turn(glm::rotate(mat4(1), environment.rotation, vec3(0, 1, 0)));
  scene::Mesh mesh;
  std::vector<vec2> uv;
  for (unsigned y = 0; y <= rows; ++y) {
    for (unsigned x = 0; x <= columns; ++x) {
      const vec2 t(static_cast<float>(x) / columns, static_cast<float>(y) / rows);
      uv.push_back(t);
      mesh.positions.push_back(bounds.center() + distance * (turn * image::equirect_direction(t.x, t.y)));
      if (x == columns || y == rows) continue;
      const unsigned a = y * (columns + 1) + x, b = a + columns + 1;
      if (y + 1 < rows) mesh.triangles.emplace_back(a, b, b + 1);
      if (y > 0) mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  }
  image::Image radiance(environment.equirect.width, environment.equirect.height);
  for (int y = 0; y < radiance.height; ++y)
    for (int x = 0; x < radiance.width; ++x)
      radiance.set_rgb(x, y, environment.color * environment.equirect.rgb(x, y));
  open_emission(e, "sky");
  e.mtl.open("color");
  map(e.mtl, e.textures.image("environment.exr", radiance), {});
  e.mtl.close(4);
  write_mesh(e, environment.name, "sky", mesh, std::move(uv));
  e.differences.add("environment images glow on a sphere of 1000 radii of the scene", environment.name);
}

void write_camera(XmlWriter& scn, const ExportSettings& settings, const scene::CameraPose& pose) {
  if (pose.camera.orthographic) {
    throw Error("--to corona", fmt::format("the camera '{}' is orthographic", pose.camera.name),
                "choose a perspective camera with --camera: no other is documented for Corona Standalone");
  }
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  const vec3 origin(pose.world[3]);
  scn.open("camera", {{"class", "perspective"}});
  scn.text("origin", numbers(origin));
  scn.text("target", numbers(origin - vec3(pose.world[2])));
  scn.text("roll", numbers(vec3(pose.world[1])));
  const float horizontal = 2 * std::atan(aspect * std::tan(0.5f * pose.camera.yfov));
  scn.text("fov", fmt::format("{}", glm::degrees(horizontal)));
  scn.close();
}

// A file for each view, which differ in the camera alone; the first stands in place of the first of all.
void write_views(Export& e) {
  std::vector<std::filesystem::path> files;
  for (const scene::CameraPose& pose : cameras_of(e.settings)) {
    files.push_back(e.directory /
                    (e.settings.cube_at ? fmt::format("face{}.scn", files.size()) : "scene.scn"));
    XmlWriter scn = e.scn;
    write_camera(scn, e.settings, pose);
    scn.close();
    write_file(files.back(), scn.str());
  }
  e.files.insert(e.files.begin(), files.begin(), files.end());
}

std::string configuration(const ExportSettings& settings) {
  return fmt::format(
      "Int image.width = {}\nInt image.height = {}\nFloat colorMap.simpleExposure = 0\n"
      "Int shading.maxRayDepth = {}\nInt progressive.passLimit = {}\n",
      settings.width, settings.height, settings.max_depth, settings.spp);
}

}  // namespace
}  // namespace corona

ExportReport export_corona(const scene::Scene& given, const ExportSettings& settings,
                           const std::filesystem::path& directory) {
  using namespace corona;
  const scene::Scene scene = begin_export(given, settings, directory);
  const FlatScene flat = flatten(scene, settings.time);
  const scene::Bounds bounds = bounds_of(flat);
  Export e{scene, settings, directory, TextureFiles(scene, directory), XmlWriter(false), XmlWriter(false),
           {},    {},       0};
  note_area_lamps(given, e.differences);
  e.scn.open("scene");
  e.scn.text("confFile", "scene.conf");
  e.scn.text("mtlLib", "scene.mtl");
  e.mtl.open("mtlLib");
  if (scene.environment && scene.environment->equirect.empty())
    e.scn.text("environment", numbers(scene.environment->color));
  std::set<std::string> written;
  for (const FlatMesh& mesh : flat.meshes) {
    const scene::Material& m = material_of(scene, mesh);
    const std::string id = material_id(scene, mesh);
    if (written.insert(id).second) write_material(e, id, m);
    if (!mesh.mesh.colors.empty()) e.differences.add("vertex colours are left out", m.name);
    write_mesh(e, mesh.name, id, mesh.mesh, texture_coordinates(mesh.mesh, leading_texture(m)));
  }
  for (std::size_t i = 0; i < flat.lights.size(); ++i) write_light(e, i, flat.lights[i], bounds);
  if (scene.environment && !scene.environment->equirect.empty()) write_sky(e, *scene.environment, bounds);
  e.mtl.close();
  write_file(directory / "scene.mtl", e.mtl.str());
  write_file(directory / "scene.conf", configuration(settings));
  note_shown_emitters(scene, flat, settings, e.differences);
  write_views(e);

  e.files.insert(e.files.end(), {directory / "scene.mtl", directory / "scene.conf"});
  const std::string command =
      settings.cube_at ? for_each_face(fmt::format("Corona.exe {} -silent -oR face$f.exr",
                                                   (directory / "face$f.scn").string()))
                       : fmt::format("Corona.exe {} -silent -oR picture.exr", e.files.front().string());
  return end_export(std::move(e.files), e.textures, e.differences, command);
}

}  // namespace ssphh::scene_io
