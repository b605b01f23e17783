#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/core/log.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/keyed_files.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/query.h>
#include <ssphh/study/default_view.h>

namespace ssphh::pipeline {
namespace {

std::string names_text(const std::vector<std::string>& names) {
  constexpr std::size_t most = 6;
  const std::size_t shown = std::min(names.size(), most);
  const std::string list =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return fmt::format("{} ({}{})", names.size(), list, shown < names.size() ? ", ..." : "");
}

}  // namespace

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
  probes::ProbeSet set;
  if (const std::vector<probes::ProbeKey> keys = probes::read_probe_keys(file);
      keys.size() == 1 && !keys.front().time) {
    set = probes::read_probe_file(file);
    require_same_scene(file, set, scene, scene::light_groups(scene), time, force);
  } else {
    const std::vector<probes::KeyedSet> sets = probes::read_keyed_sets(keys);
    for (const probes::KeyedSet& key : sets)
      require_same_scene(file, key.set, scene, scene::light_groups(scene), {}, force);
    probes::BlendedSet blended = probes::light_at(sets, time.value_or(0));
    if (!blended.left_out.empty())
      log_warning("{}: not blended: {}", file, fmt::join(blended.left_out, ", "));
    set = std::move(blended.set);
  }
  if (bake::mode_difference(set, scene).empty()) bake::adopt_modes(set, scene);
  return set;
}

std::vector<vec3> viewpoints(const scene::Scene& scene, const rays::TransportSource& source,
                             std::span<const probes::ProbeSet> sets, float time) {
  std::vector<vec3> places;
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  for (const scene::Camera& camera : scene.cameras) places.emplace_back(world[camera.node][3]);
  for (const probes::ProbeSet& set : sets) {
    for (const probes::Probe& probe : set.probes) places.push_back(probe.position);
  }
  if (sets.empty()) {
    const place::PlaceParams own = place::place_params(scene, time);
    places.insert(places.end(), own.interest.begin(), own.interest.end());
    for (const scene::ProbePlace& place : own.manual) places.push_back(place.position);
  }
  if (places.empty()) places.emplace_back(study::default_view(scene, source, time).world[3]);
  return places;
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

}  // namespace ssphh::pipeline
