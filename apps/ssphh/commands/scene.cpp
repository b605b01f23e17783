#include "commands/scene.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>

#include "commands/command.h"
#include "results/json_values.h"

namespace ssphh::app {
namespace {

template <class T>
std::vector<std::string> item_names(const std::vector<T>& items) {
  std::vector<std::string> names;
  for (const T& item : items) names.push_back(item.name);
  return names;
}

std::string list(const std::vector<std::string>& items) {
  return items.empty() ? "none" : fmt::format("{}", fmt::join(items, ", "));
}

}  // namespace

SceneListResult run_scene_list(const SceneListOptions&, const Control&) {
  return {scene::builtin_scenes()};
}

json::Value to_json(const SceneListResult& result, const SceneListOptions&) {
  json::Value scenes = json::Value::array();
  for (const scene::BuiltinScene& scene : result.scenes) {
    json::Value entry = {{"name", "builtin:" + scene.name}, {"description", scene.description}};
    if (const auto& number = scene.number) {
      entry["number"] = {
          {"key", number->key}, {"least", number->least}, {"most", number->most}, {"usual", number->usual}};
    }
    scenes.push_back(std::move(entry));
  }
  return {{"scenes", std::move(scenes)}};
}

std::string to_text(const SceneListResult& result, const SceneListOptions&) {
  std::string text;
  for (const scene::BuiltinScene& scene : result.scenes) {
    const std::string name =
        "builtin:" + scene.name + (scene.number ? "?" + scene.number->key + "=N" : std::string());
    text += fmt::format("{}{:<22} {}", text.empty() ? "" : "\n", name, scene.description);
  }
  return text;
}

SceneInfo run_scene_info(const SceneOptions& options, const Control&) {
  const scene::Scene scene = load_scene(options);
  const auto count = [&](const auto& has) {
    return static_cast<std::size_t>(
        std::ranges::count_if(scene.instances, [&](const scene::Instance& instance) {
          const int material = scene::instance_material(scene, instance);
          return material >= 0 && has(scene.materials[material]);
        }));
  };
  SceneInfo info;
  info.name = scene.name;
  info.triangles = scene::triangle_count(scene);
  info.meshes = scene.meshes.size();
  info.instances = scene.instances.size();
  info.materials = scene.materials.size();
  info.textures = scene.textures.size();
  info.lights = scene.lights.size();
  info.animations = scene.animations.size();
  info.emissive_instances = count([](const scene::Material& m) { return m.emissive(); });
  info.glass_sheets = count([](const scene::Material& m) { return m.is_glass() && !(m.thickness > 0); });
  info.glass_bodies = count([](const scene::Material& m) { return m.is_glass() && m.thickness > 0; });
  info.movable = static_cast<std::size_t>(std::ranges::count(scene.nodes, true, &scene::Node::movable));
  info.environment = scene.environment.has_value();
  info.light_groups = scene::light_groups(scene);
  for (const scene::Light& light : scene.lights) {
    info.lamps.emplace_back(light.name, light.type);
    if (!light.profile.empty()) info.lamp_profiles.push_back({light.name, light.profile.name});
  }
  info.cameras = item_names(scene.cameras);
  info.sphls = item_names(scene.sphls);
  info.places = scene::sphl_places(scene, options.time);
  info.animation_seconds = scene::animation_duration(scene);
  info.bounds = scene::world_bounds(scene, scene::world_matrices(scene, options.time));
  info.hash = scene::scene_hash(scene);
  info.ignored = scene.ignored;
  return info;
}

json::Value to_json(const SceneInfo& info, const SceneOptions& options) {
  json::Value places = json::Value::array(), bounds;
  for (const scene::ProbePlace& place : info.places)
    places.push_back({{"name", place.name}, {"position", to_json(place.position)}, {"radius", place.radius}});
  json::Value lamps = json::Value::array(), profiles = json::Value::array();
  for (const auto& [lamp, type] : info.lamps)
    lamps.push_back({{"name", lamp}, {"type", std::string(name_of(type))}});
  for (const auto& [lamp, profile] : info.lamp_profiles)
    profiles.push_back({{"lamp", lamp}, {"profile", profile}});
  if (!info.bounds.empty()) bounds = {{"min", to_json(info.bounds.min)}, {"max", to_json(info.bounds.max)}};
  return {{"scene", options.source},
          {"name", info.name},
          {"triangles", info.triangles},
          {"meshes", info.meshes},
          {"instances", info.instances},
          {"materials", info.materials},
          {"textures", info.textures},
          {"lights", info.lights},
          {"lamps", std::move(lamps)},
          {"emissive_instances", info.emissive_instances},
          {"glass_sheets", info.glass_sheets},
          {"glass_bodies", info.glass_bodies},
          {"environment", info.environment},
          {"light_groups", info.light_groups},
          {"lamp_profiles", std::move(profiles)},
          {"cameras", info.cameras.size()},
          {"camera_names", info.cameras},
          {"sphls", info.sphls.size()},
          {"sphl_places", std::move(places)},
          {"movable", info.movable},
          {"animations", info.animations},
          {"animation_seconds", info.animation_seconds},
          {"bounds", std::move(bounds)},
          {"hash", info.hash.hex()},
          {"ignored", info.ignored}};
}

std::string to_text(const SceneInfo& info, const SceneOptions& options) {
  std::string text = options.source + (info.name.empty() ? "" : " (" + info.name + ")");
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("\n{:<13}{}", what, value);
  };
  const vec3 &min = info.bounds.min, &max = info.bounds.max;
  line("triangles", fmt::format("{} in {} of {}", info.triangles, counted(info.instances, "instance"),
                                counted(info.meshes, "mesh", "meshes")));
  line("materials", fmt::format("{}, {}", info.materials, counted(info.textures, "texture")));
  if (info.glass_sheets + info.glass_bodies > 0) {
    line("glass", fmt::format("{} of thin sheets, {} of solid bodies", counted(info.glass_sheets, "instance"),
                              info.glass_bodies));
  }
  line("lights", fmt::format("{}, {}, {}", info.lights, counted(info.emissive_instances, "emissive instance"),
                             info.environment ? "environment" : "no environment"));
  if (!info.lamps.empty()) {
    std::vector<std::string> lamps;
    for (const auto& [lamp, type] : info.lamps) lamps.push_back(fmt::format("{} ({})", lamp, name_of(type)));
    line("lamps", list(lamps));
  }
  line("light groups", list(info.light_groups));
  if (!info.lamp_profiles.empty()) {
    std::vector<std::string> profiles;
    for (const auto& [lamp, profile] : info.lamp_profiles)
      profiles.push_back(fmt::format("{} of {}", profile, lamp));
    line("profiles", list(profiles));
  }
  line("cameras", list(info.cameras));
  line("SPHLs", (info.sphls.empty() ? "" : fmt::format("{}: ", info.sphls.size())) + list(info.sphls));
  line("movable",
       fmt::format("{}; animations last {:g} s", counted(info.movable, "node"), info.animation_seconds));
  line("bounds", info.bounds.empty() ? "empty"
                                     : fmt::format("{:.3f} {:.3f} {:.3f} to {:.3f} {:.3f} {:.3f} m", min.x,
                                                   min.y, min.z, max.x, max.y, max.z));
  line("ignored",
       info.ignored.empty() ? "nothing" : fmt::format("{}", fmt::join(info.ignored, "\n             ")));
  return text;
}

void add_scene_commands(Command app, Context& context) {
  Command group = add_group(app, "scene", "List the built-in scenes, look into a scene");
  add_command(group, context, "list", "The built-in scenes", run_scene_list);
  auto [info, options] = add_command(group, context, "info",
                                     "What a scene holds, and what of its file is ignored", run_scene_info);
  add_scene_options(info, options);
}

}  // namespace ssphh::app
