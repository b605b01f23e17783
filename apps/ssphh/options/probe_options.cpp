#include "options/probe_options.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/core/log.h>
#include <ssphh/place/place.h>
#include <ssphh/scene/query.h>
#include <ssphh/study/default_view.h>

namespace ssphh::app {
namespace {

std::string names_text(const std::vector<std::string>& names) {
  constexpr std::size_t most = 6;
  const std::size_t shown = std::min(names.size(), most);
  const std::string list =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return fmt::format("{} ({}{})", names.size(), list, shown < names.size() ? ", ..." : "");
}

std::string probe_file_problem(const std::string& name) {
  try {
    probes::probe_file_format(name);
    return {};
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace

Option add_probe_file(const Command& command, const std::string& names, std::string& file,
                      const std::string& help) {
  return command.option(names, file, help).check(probe_file_problem, ".sphl|.sphl.json");
}

Option add_probe_files(const Command& command, const std::string& names, std::vector<std::string>& files,
                       const std::string& help) {
  return command.option(names, files, help).check(probe_file_problem, ".sphl|.sphl.json");
}

Option add_force_option(Command command, bool& force) {
  return command.flag("--force", force,
                      "Go on with a warning where the probes were baked in another scene or pose");
}

std::string scene_difference(const probes::ProbeSet& set, const scene::Scene& scene,
                             const std::vector<std::string>& light_groups, std::optional<float> time) {
  const probes::GeneratorInfo& g = set.generator;
  std::string text;
  const auto say = [&](const std::string& difference) { text += (text.empty() ? "" : "; ") + difference; };
  const Hash128 now = scene::light_hash(scene);
  if (g.scene_hash != now) {
    if (g.scene != scene.name) say(fmt::format("scene \"{}\", now \"{}\"", g.scene, scene.name));
    say(fmt::format("geometry, materials or lights (hash {:.8}, now {:.8})", g.scene_hash.hex(), now.hex()));
    std::vector<std::string> baked;
    for (const probes::LightGroup& group : set.light_groups) baked.push_back(group.name);
    if (baked != light_groups)
      say(fmt::format("light groups: {}, now {}", names_text(baked), names_text(light_groups)));
  }
  if (const std::string modes = bake::mode_difference(set, scene); !modes.empty()) say(modes);
  if (time && *time != g.time && scene::animation_duration(scene) > 0)
    say(fmt::format("time {:g} s, now {:g} s", g.time, *time));
  return text;
}

void require_same_scene(const std::string& file, const probes::ProbeSet& set, const scene::Scene& scene,
                        const std::vector<std::string>& light_groups, std::optional<float> time, bool force) {
  const std::string difference = scene_difference(set, scene, light_groups, time);
  if (difference.empty()) return;
  const std::string problem = "was baked in another scene or pose: " + difference;
  if (!force) throw Error(file, problem, "bake it anew, give the options of its bake, or go on with --force");
  log_warning("{}: {}", file, problem);
}

probes::ProbeSet read_probes_of(const scene::Scene& scene, const std::string& file, std::optional<float> time,
                                bool force) {
  probes::ProbeSet set = probes::read_probe_file(file);
  require_same_scene(file, set, scene, scene::light_groups(scene), time, force);
  return set;
}

std::vector<vec3> viewpoints(const scene::Scene& scene, const rays::TransportSource& source,
                             std::span<const probes::ProbeSet> sets, float time) {
  std::vector<vec3> places;
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  for (const scene::Camera& camera : scene.cameras)
    places.emplace_back(world[static_cast<std::size_t>(camera.node)][3]);
  for (const probes::ProbeSet& set : sets) {
    for (const probes::Probe& probe : set.probes) places.push_back(probe.position);
  }
  if (sets.empty()) {
    const place::PlaceParams own = place::place_params(scene, time);
    places.insert(places.end(), own.interest.begin(), own.interest.end());
    for (const scene::SphlPlace& place : own.manual) places.push_back(place.position);
  }
  if (places.empty()) places.emplace_back(study::default_view(scene, source, time).world[3]);
  return places;
}

Option add_lookup_option(Command command, probes::LookupMethod& method) {
  return command.choice("--lookup", method,
                        "irradiance: blend of visible SPHLs; light: nearest visible SPHL, as the paper");
}

Option add_weights_option(Command command, std::optional<probes::WeightMethod>& weights) {
  return command.choice(
      "--weights", weights,
      "How --lookup irradiance finds light: surface (records of `bake --records`, with SPHLs for what moves; "
      "the default where a file has any), fitted (SPHLs by weights of `bake --fit`, with mls for what moves; "
      "else the default), mls (moving least squares over SPHLs; else the default), trilinear (SPHLs on a "
      "grid), distance (nearest visible ones)");
}

Option add_layer_option(Command command, probes::ProbeLayer& layer) {
  return command.choice("--light", layer,
                        "sum: own and neighbours' light where HIER was run; self: own light only",
                        {"sum", "self"});
}

Option add_truth_path_options(const Command& command, int& spp, int& max_depth) {
  const Option paths = command.option("--truth-spp", spp, "Paths per point").range(2, 1 << 22);
  command.option("--max-depth", max_depth, "Scattering events of a path").range(2, 1000);
  return paths;
}

probes::LookupParams lookup_params(const std::string& file, const probes::ProbeSet& set,
                                   const probes::LookupSpec& spec) {
  if (spec.weights == probes::WeightMethod::fitted && !set.fitted)
    throw Error(file, "has no fitted weights", "bake it with --fit, or choose other --weights");
  const probes::LookupParams params = probes::lookup_params(spec, set);
  if (spec.weights == probes::WeightMethod::surface && !probes::has_records(set, params))
    throw Error(file, "has no surface records of this light",
                "bake it with --records, or choose other --weights");
  return params;
}

}  // namespace ssphh::app
