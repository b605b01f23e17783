#include "overlay_file.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/scene/calendar.h>
#include <ssphh/scene_io/ies.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/overlay.h>

namespace ssphh::viewer {
namespace {

namespace fs = std::filesystem;

/// With no more digits than the float has, so that it is read back as it was.
json::Value number(float value) {
  return std::stod(fmt::format("{}", value));
}

json::Value vector(const vec3& v) {
  return json::Value::array({number(v.x), number(v.y), number(v.z)});
}

json::Value degrees(float radians) {
  return number(glm::degrees(radians));
}

/// In the overlay's folder by the way from there, else by the whole path.
std::string path_from(const fs::path& folder, const std::string& file) {
  if (file.starts_with("builtin:")) return file;
  const fs::path whole = fs::absolute(file).lexically_normal();
  // No name of a folder is the current one.
  const fs::path from = (fs::current_path() / folder).lexically_normal();
  const fs::path way = whole.lexically_relative(from);
  return way.empty() || *way.begin() == ".." ? whole.string() : way.string();
}

void place(json::Value& entry, const mat4& world, bool turned) {
  entry["position"] = vector(vec3(world[3]));
  if (!turned) return;
  entry["direction"] = vector(light_direction(world));
  entry["up"] = vector(glm::normalize(vec3(world[1])));
}

/// Hangs on the node, where that has a name of its own; else false.
bool hang_on(json::Value& entry, const scene::Scene& scene, int node, bool turned) {
  const std::string& name = scene.nodes[node].name;
  if (name.empty() || std::ranges::count(scene.nodes, name, &scene::Node::name) > 1) return false;
  entry["node"] = name;
  if (turned) entry["direction"] = vector({0, 0, -1});
  return true;
}

json::Value coefficients(const sh::IntensitySh& light) {
  json::Value out = json::Value::array();
  for (const vec3& c : light.values)
    for (int i = 0; i < 3; ++i) out.push_back(number(c[i]));
  return out;
}

json::Value emission(const scene::Emission& e) {
  json::Value out = json::Value::object();
  if (e.frames.size() == 1) {
    out["coefficients"] = coefficients(e.frames[0]);
    return out;
  }
  for (const sh::IntensitySh& frame : e.frames) out["frames"].push_back(coefficients(frame));
  out["rate"] = number(e.rate), out["start"] = number(e.start), out["repeat"] = e.repeat;
  return out;
}

/// Members of an overlay for a list of things with names: `without` names that are changed or gone, and
/// entries for all things of those names and for new ones.
template <class List, class Own, class Changed, class Entry>
void add_list(json::Value& overlay, const char* key, const List& now, const Own& own, const Changed& changed,
              const Entry& entry) {
  std::set<std::string> out;
  std::vector<bool> kept(own.size(), false);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].source < 0) continue;
    kept[now[i].source] = true;
    if (changed(i)) out.insert(own[now[i].source].name);
  }
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!kept[i]) out.insert(own[i].name);
  for (const std::string& name : out) overlay["without"][key].push_back(name);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].source < 0 || out.contains(own[now[i].source].name)) overlay[key].push_back(entry(i));
  }
}

void add_lights(json::Value& overlay, const Document& document, bool sun_of_sky) {
  const scene::Scene& own = *document.opened;
  const std::vector<LightEdit>& edits = document.edits().lights;
  const std::vector<scene::LightState> states = document.lighting().lights;
  const std::vector<scene::LightState> before = scene::lighting_at(own, document.time).lights;
  const int sun = sun_of_sky ? scene::sun_light(*document.opened) : -1;
  const auto moved = [&](std::size_t i) {
    return edits[i].source < 0 || states[i].world != before[edits[i].source].world;
  };
  const auto changed = [&](std::size_t i) {
    const auto source = static_cast<std::size_t>(edits[i].source);
    if (edits[i].source == sun) return false;
    return moved(i) || states[i].color != before[source].color ||
           states[i].intensity != before[source].intensity || edits[i].lamp != lamp_of(own.lights[source]);
  };
  add_list(overlay, "lights", edits, own.lights, changed, [&](std::size_t i) {
    const Lamp& lamp = edits[i].lamp;
    using enum scene::LightType;
    json::Value entry = {{"name", lamp.name}, {"type", std::string(name_of(lamp.type))}};
    if (!lamp.group.empty()) entry["light_group"] = lamp.group;
    const bool turned = has_direction(lamp.type, lamp.profile);
    if (moved(i) || !hang_on(entry, own, own.lights[edits[i].source].node, turned))
      place(entry, states[i].world, turned);
    entry["color"] = vector(states[i].color);
    entry["intensity"] = number(states[i].intensity);
    if (lamp.type == sphere || lamp.type == sphl || lamp.type == disc) entry["radius"] = number(lamp.radius);
    if (lamp.type == rectangle) {
      entry["width"] = number(lamp.size.x);
      entry["height"] = number(lamp.size.y);
    }
    if (lamp.type == sphl) entry["emission"] = emission(lamp.emission);
    if (lamp.type == directional) entry["angular_diameter_degrees"] = degrees(2 * lamp.angular_radius);
    if (lamp.type == spot) {
      entry["outer_cone_degrees"] = degrees(lamp.outer_cone);
      entry["inner_cone_degrees"] = degrees(std::min(lamp.inner_cone, lamp.outer_cone));
    }
    if (lamp.range > 0) entry["range"] = number(lamp.range);
    if (!lamp.profile.empty()) {
      entry["profile"]["ies"] = scene_io::ies_to_text(lamp.profile);
      entry["profile"]["name"] = lamp.profile.name;
    }
    return entry;
  });
}

void add_sphls(json::Value& overlay, const Document& document) {
  const scene::Scene& own = *document.opened;
  const std::vector<SphlEdit>& edits = document.edits().sphls;
  const std::vector<SphlEdit> before = edits_of(own).sphls;
  const std::vector<mat4> world = scene::world_matrices(own, document.time);
  const auto changed = [&](std::size_t i) { return edits[i] != before[edits[i].source]; };
  add_list(overlay, "sphls", edits, own.sphls, changed, [&](std::size_t i) {
    json::Value entry = {{"name", edits[i].name}};
    const bool there = !edits[i].position && hang_on(entry, own, own.sphls[edits[i].source].node, false);
    entry["position"] = vector(there ? vec3(0) : sphl_position(own, world, edits[i]));
    entry["radius"] = number(edits[i].radius);
    entry["enabled"] = edits[i].enabled;
    return entry;
  });
}

void add_cameras(json::Value& overlay, const Document& document) {
  const scene::Scene& own = *document.opened;
  const std::vector<CameraEdit>& edits = document.edits().cameras;
  const auto changed = [&](std::size_t i) {
    return edits[i].view || edits[i].name != own.cameras[edits[i].source].name;
  };
  add_list(overlay, "cameras", edits, own.cameras, changed, [&](std::size_t i) {
    const CameraEdit& edit = edits[i];
    scene::Camera camera = edit.source >= 0 ? own.cameras[edit.source] : scene::Camera{};
    json::Value entry = {{"name", edit.name}};
    if (edit.view) {
      const scene::CameraPose pose = pose_of(*edit.view);
      place(entry, pose.world, true);
      camera.orthographic = pose.camera.orthographic;
      camera.yfov = pose.camera.yfov, camera.yheight = pose.camera.yheight;
    } else if (!hang_on(entry, own, camera.node, false)) {
      place(entry, scene::world_matrix(own, camera.node, document.time), true);
    }
    if (camera.orthographic) entry["yheight"] = number(camera.yheight);
    if (!camera.orthographic) entry["yfov_degrees"] = degrees(camera.yfov);
    if (camera.aspect) entry["aspect"] = number(*camera.aspect);
    return entry;
  });
}

void add_materials(json::Value& overlay, const Document& document) {
  const std::vector<scene::Material>&own = document.opened->materials, &now = document.edits().materials;
  std::set<std::string> done;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const scene::Material& m = now[i];
    if (same_surface(m, own[i])) continue;
    const bool alike = std::ranges::all_of(
        now, [&](const scene::Material& other) { return other.name != m.name || same_surface(other, m); });
    if (m.name.empty() || !alike)
      throw Error(fmt::format("material \"{}\"", m.name),
                  "an overlay changes materials by their names, and this name is not its own",
                  "save the scene as .glb");
    if (!done.insert(m.name).second) continue;
    json::Value entry = {{"name", m.name},
                         {"base_color", vector(m.base_color)},
                         {"alpha", number(m.alpha)},
                         {"metallic", number(m.metallic)},
                         {"diffuse_roughness", number(m.diffuse_roughness)},
                         {"specular_roughness", number(m.specular_roughness)},
                         {"specular", number(m.specular)},
                         {"ior", number(m.ior)},
                         {"transmission", number(m.transmission)},
                         {"thickness", number(m.thickness)},
                         {"attenuation_color", vector(m.attenuation_color)},
                         {"emission", vector(m.emission)}};
    if (m.attenuation_distance > 0) entry["attenuation_distance"] = number(m.attenuation_distance);
    overlay["materials"].push_back(entry);
  }
}

/// `lamp`: whether the sun's lamp comes with it.
json::Value sky_of(const scene::SunSkyParams& sky, bool lamp) {
  json::Value out = {{"model", std::string(name_of(sky.model))},
                     {"turbidity", number(sky.turbidity)},
                     {"ground_albedo", vector(sky.ground_albedo)},
                     {"sun", sky.sun},
                     {"lamp", lamp},
                     {"width", sky.width}};
  // By angles: the clock's minutes would round the sun's place.
  out["elevation_degrees"] = degrees(sky.elevation);
  out["azimuth_degrees"] = degrees(std::remainder(sky.azimuth + pi / 2, 2 * pi));
  return out;
}

}  // namespace

OpenedFiles opened_files(const std::string& source, const std::string& overlay) {
  OpenedFiles files{source, {}};
  std::error_code ignored;
  if (source.ends_with(".json")) {
    files.scene = scene_io::overlay_scene(read_text_file(source), source);
    files.overlays.push_back(source);
  }
  if (!overlay.empty()) {
    files.overlays.push_back(overlay);
  } else if (files.overlays.empty() && !source.starts_with("builtin:")) {
    const fs::path beside = scene_io::overlay_beside(source);
    if (fs::exists(beside, ignored)) files.overlays.push_back(beside.string());
  }
  return files;
}

json::Value overlay_of(const Document& document, const fs::path& folder) {
  const OpenedFiles below = opened_files(document.source, document.overlay);
  json::Value overlay = {{"scene", path_from(folder, below.scene)}};
  for (const std::string& file : below.overlays) overlay["overlays"].push_back(path_from(folder, file));
  const Edits& edits = document.edits();
  // The sun follows from the sky where nobody took it from there.
  const int sun = edits.sky ? scene::sun_light(*document.scene) : -1;
  bool of_sky = sun >= 0 && edits.environment_rotation == 0;
  if (of_sky) {
    const LightEdit& edit = edits.lights[sun];
    const scene::Light& own = document.scene->lights[sun];
    of_sky = !edit.world && edit.on && edit.color == own.color && edit.intensity == own.intensity;
  }
  add_lights(overlay, document, of_sky);
  add_sphls(overlay, document);
  add_cameras(overlay, document);
  add_materials(overlay, document);
  if (edits.sky) overlay["sun_sky"] = sky_of(edits.sky->params, of_sky);
  if (edits.surroundings) {
    overlay["environment"]["image"] = path_from(folder, edits.surroundings->file);
    const scene::Environment& own = *document.scene->environment;
    overlay["environment"]["name"] = own.name;
    if (!own.group.empty()) overlay["environment"]["light_group"] = own.group;
  }
  if (edits.environment_rotation != 0)
    overlay["environment_turn_degrees"] = degrees(edits.environment_rotation);
  for (const auto& [group, factor] : edits.groups) overlay["light_factors"][group] = vector(factor);
  return overlay;
}

}  // namespace ssphh::viewer
