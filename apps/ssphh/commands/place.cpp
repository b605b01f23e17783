#include "commands/place.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/scene_io/overlay.h>

#include "commands/command.h"
#include "results/json_values.h"

namespace ssphh::app {
namespace {

namespace fs = std::filesystem;

bool is_overlay_name(const std::string& name) {
  return name.ends_with(".ssphh.json");
}

/// A path as the file beside `output` names it.
std::string from_output(const fs::path& path, const fs::path& output) {
  const fs::path folder = fs::absolute(output).parent_path();
  return fs::absolute(path).lexically_normal().lexically_relative(folder.lexically_normal()).generic_string();
}

/// The overlay that lies on the scene, if there is one, else an empty one; its paths as `output` needs them.
json::Value base_overlay(const SceneOptions& scene, const fs::path& output) {
  fs::path overlay = scene.overlay;
  json::Value base = json::Value::object();
  std::string named = scene.source;
  if (is_overlay_name(scene.source)) {
    if (!overlay.empty()) {
      throw Error("--overlay", "cannot be written together with the overlay that is the scene",
                  "leave one of them out");
    }
    overlay = scene.source;
    named = scene_io::overlay_scene(read_text_file(overlay), overlay);
  } else if (const fs::path beside = fs::path(scene.source).replace_extension(".ssphh.json");
             overlay.empty() && fs::exists(beside)) {
    overlay = beside;
  }
  if (!overlay.empty()) {
    base = json::parse(read_text_file(overlay), overlay.string());
    if (base.contains("environment") && base["environment"].contains("image")) {
      json::Value& image = base["environment"]["image"];
      const fs::path path = scene_io::expand_variables(image.string(), overlay.string());
      image = from_output(path.is_absolute() ? path : overlay.parent_path() / path, output);
    }
    base.erase("$schema");
  }
  base["scene"] = named.starts_with("builtin:") ? named : from_output(named, output);
  return base;
}

}  // namespace

PlaceResult run_place(const PlaceOverlayOptions& options, const Control& control) {
  if (fs::weakly_canonical(options.output) == fs::weakly_canonical(options.scene.source)) {
    throw Error(options.output, "is the scene itself", "choose another name with -o");
  }
  const scene::Scene scene = load_scene(options.scene);
  std::optional<PlaceResult> result = place_for(std::make_shared<const trace::SceneGeometry>(scene), scene,
                                                options.scene.time, options.place, "auto", control);
  if (!result)
    throw Error("--probes scene", "there is nothing to place", "use auto, auto:METRES or a number");

  json::Value overlay = base_overlay(options.scene, options.output);
  if (!options.scene.unit.empty()) overlay["unit"] = options.scene.unit;
  for (const place::PlacedProbe& probe : result->placement.probes) {
    if (probe.kind == place::PlaceKind::manual) continue;
    overlay["sphls"].push_back(
        {{"name", probe.name}, {"position", to_json(probe.position)}, {"radius", probe.radius}});
  }
  write_file(options.output, json::print(overlay, 1) + "\n");
  return std::move(*result);
}

json::Value to_json(const PlaceResult& result, const PlaceOverlayOptions& options) {
  json::Value object = place_json(result);
  object["output"] = options.output;
  return object;
}

std::string to_text(const PlaceResult& result, const PlaceOverlayOptions& options) {
  return fmt::format("{}: {}", options.output, place_text(result));
}

void add_place_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "place", "Find places for SPHLs and write them as an overlay", run_place);
  add_scene_options(command, o.scene);
  add_place_options(command, o.place);
  command.option("-o,--output", o.output, "Overlay to write: a scene of its own, to look at and edit")
      .check(
          [](const std::string& name) {
            return is_overlay_name(name) ? std::string() : "the name must end with .ssphh.json";
          },
          ".ssphh.json")
      .required();
  command.footer(
      "OUTPUT names SCENE, repeats the overlay that lies on it and adds the places found; bake it with\n"
      "`ssphh bake OUTPUT --probes scene`. An environment from the command line is not written.");
}

}  // namespace ssphh::app
