#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "commands/command.h"
#include "options/scene_options.h"

namespace ssphh::app {
namespace {

void list_scenes(const Context& context) {
  json::Value scenes = json::Value::array();
  std::string text;
  for (const scene::BuiltinScene& scene : scene::builtin_scenes()) {
    const std::string name = "builtin:" + scene.name;
    scenes.push_back({{"name", name}, {"description", scene.description}});
    text += fmt::format("{}{:<20} {}", text.empty() ? "" : "\n", name, scene.description);
  }
  context.result({{"scenes", std::move(scenes)}}, text);
}

template <class T>
std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  for (const T& item : items) names.push_back(item.name);
  return names;
}

json::Value to_json(const vec3& v) {
  return {v.x, v.y, v.z};
}

void show_scene(const Context& context, const SceneOptions& options) {
  const scene::Scene scene = load_scene(options);
  const scene::Bounds bounds = scene::world_bounds(scene, scene::world_matrices(scene, options.time));
  const auto movable =
      std::count_if(scene.nodes.begin(), scene.nodes.end(), [](const auto& n) { return n.movable; });
  const auto emitters =
      std::count_if(scene.instances.begin(), scene.instances.end(), [&](const auto& instance) {
        const int material = scene::instance_material(scene, instance);
        return material >= 0 && scene.materials[static_cast<std::size_t>(material)].emissive();
      });
  const std::vector<std::string> groups = scene::light_groups(scene);
  const float duration = scene::animation_duration(scene);
  json::Value sphls = json::Value::array();
  for (const scene::SphlPlace& place : scene::sphl_places(scene, options.time)) {
    sphls.push_back({{"name", place.name}, {"position", to_json(place.position)}, {"radius", place.radius}});
  }

  const json::Value object = {
      {"scene", options.source},
      {"name", scene.name},
      {"triangles", scene::triangle_count(scene)},
      {"meshes", scene.meshes.size()},
      {"instances", scene.instances.size()},
      {"materials", scene.materials.size()},
      {"textures", scene.textures.size()},
      {"lights", scene.lights.size()},
      {"emissive_instances", emitters},
      {"environment", scene.environment.has_value()},
      {"light_groups", groups},
      {"cameras", scene.cameras.size()},
      {"camera_names", names_of(scene.cameras)},
      {"sphls", scene.sphls.size()},
      {"sphl_places", std::move(sphls)},
      {"movable", movable},
      {"animations", scene.animations.size()},
      {"animation_seconds", duration},
      {"bounds", bounds.empty() ? json::Value(nullptr)
                                : json::Value{{"min", to_json(bounds.min)}, {"max", to_json(bounds.max)}}},
      {"hash", scene::scene_hash(scene).hex()},
      {"ignored", scene.ignored}};

  std::string text = fmt::format("{}{}\n", options.source, scene.name.empty() ? "" : " (" + scene.name + ")");
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("{:<13}{}\n", what, value);
  };
  line("triangles", fmt::format("{} in {} instances of {} meshes", scene::triangle_count(scene),
                                scene.instances.size(), scene.meshes.size()));
  line("materials", fmt::format("{}, {} textures", scene.materials.size(), scene.textures.size()));
  line("lights", fmt::format("{}, {} emissive instances, {}", scene.lights.size(), emitters,
                             scene.environment ? "environment" : "no environment"));
  line("light groups", groups.empty() ? "none" : fmt::format("{}", fmt::join(groups, ", ")));
  line("cameras",
       scene.cameras.empty() ? "none" : fmt::format("{}", fmt::join(names_of(scene.cameras), ", ")));
  line("SPHLs", scene.sphls.empty()
                    ? "none"
                    : fmt::format("{}: {}", scene.sphls.size(), fmt::join(names_of(scene.sphls), ", ")));
  line("movable", fmt::format("{} nodes; animations last {:g} s", movable, duration));
  line("bounds", bounds.empty()
                     ? "empty"
                     : fmt::format("{:.3f} {:.3f} {:.3f} to {:.3f} {:.3f} {:.3f} m", bounds.min.x,
                                   bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z));
  line("ignored",
       scene.ignored.empty() ? "nothing" : fmt::format("{}", fmt::join(scene.ignored, "\n             ")));
  text.pop_back();
  context.result(object, text);
}

}  // namespace

void add_scene_commands(Command app, Context& context) {
  Command group = add_group(app, "scene", "List the built-in scenes, look into a scene");
  add_command(group, context, "list", "The built-in scenes", [&context] { list_scenes(context); });

  auto info = std::make_shared<SceneOptions>();
  Command info_command =
      add_command(group, context, "info", "What a scene holds, and what of its file is ignored",
                  [&context, info] { show_scene(context, *info); });
  add_scene_options(info_command, *info);
}

}  // namespace ssphh::app
