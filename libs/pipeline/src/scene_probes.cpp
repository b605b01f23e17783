#include <algorithm>
#include <functional>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/core/log.h>
#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/keyed_files.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/probe_limits.h>
#include <ssphh/probes/tile_folder.h>
#include <ssphh/scene/query.h>
#include <ssphh/study/default_view.h>
#include <ssphh/trace/primary_rays.h>

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

namespace {

probes::ProbeSet held_against(const scene::Scene& scene, const std::string& file, probes::ProbeSet set,
                              std::optional<float> time, bool force) {
  require_same_scene(file, set, scene, scene::light_groups(scene), time, force);
  if (bake::mode_difference(set, scene).empty()) bake::adopt_modes(set, scene);
  return set;
}

}  // namespace

probes::ProbeSet read_probes_of(const scene::Scene& scene, const std::string& file, std::optional<float> time,
                                bool force) {
  probes::ProbeSet set;
  if (const std::vector<probes::ProbeKey> keys = probes::read_probe_keys(file);
      keys.size() == 1 && !keys.front().time) {
    return held_against(scene, file, probes::read_probe_file(file), time, force);
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

namespace {

/// Where a few thousand of the picture's rays meet still surfaces.
std::vector<vec3> surfaces_in_view(const rays::TransportSource& source, const trace::RenderParams& params) {
  constexpr int across = 160, down = 90;
  const auto ray_at = trace::primary_rays(params);
  std::vector<rays::RayQuery> rays;
  for (int i = 0; i < across * down; ++i) {
    rays.push_back(
        ray_at((static_cast<float>(i % across) + 0.5f) * static_cast<float>(params.width) / across,
               (static_cast<float>(i / across) + 0.5f) * static_cast<float>(params.height) / down));
  }
  std::vector<rays::RayHit> hits(rays.size());
  source.intersect(0, rays, hits);
  std::vector<vec3> surfaces;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (!hits[i].escaped()) surfaces.push_back(rays[i].origin + hits[i].distance * rays[i].direction);
  return surfaces;
}

/// As many as a set may have probes.
std::vector<std::size_t> most_seen(std::span<const probes::Tile> tiles, std::span<const vec3> surfaces) {
  std::vector<std::size_t> order(tiles.size()), seen(tiles.size(), 0), chosen;
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const vec3& at : surfaces) {
    for (std::size_t t = 0; t < tiles.size(); ++t) seen[t] += tiles[t].box.contains(at) ? 1 : 0;
  }
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t t) { return seen[t]; });
  std::size_t probes = 0;
  for (const std::size_t t : order) {
    probes += tiles[t].own;
    if (probes > probes::limits::probes || (seen[t] == 0 && !chosen.empty())) break;
    chosen.push_back(t);
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace

probes::ProbeSet read_probes_in_view(const scene::Scene& scene, const std::string& file,
                                     std::optional<float> time, bool force,
                                     const rays::TransportSource& source, const trace::RenderParams& params) {
  if (!probes::is_tile_folder(file)) return read_probes_of(scene, file, time, force);
  const probes::TileFolder folder(file);
  if (probes::probe_count(folder.tiles()) <= probes::limits::probes)
    return read_probes_of(scene, file, time, force);
  const std::vector<std::size_t> which = most_seen(folder.tiles(), surfaces_in_view(source, params));
  log_info("{} of the {} tiles of {} are in the picture", which.size(), folder.tiles().size(), file);
  return held_against(scene, file, folder.join(which), time, force);
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
