#include <algorithm>

#include <fmt/format.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/query.h>
#include <ssphh/transport/projection.h>

namespace ssphh::bake {
namespace {

/// Shadows of smaller discs are sharper than records are dense, at any height that matters [rad].
constexpr float smallest_soft_disc = 0.05f;

bool casts_sharp_shadows(const scene::Light& light) {
  if (light.type == scene::LightType::sphere || scene::is_area_lamp(light.type)) return false;
  return light.type != scene::LightType::directional || light.angular_radius < smallest_soft_disc;
}

}  // namespace

std::vector<int> baked_indices(std::span<const scene::LightMode> modes) {
  std::vector<int> indices;
  for (std::size_t g = 0; g < modes.size(); ++g) {
    if (scene::keeps_direct(modes[g])) indices.push_back(static_cast<int>(g));
  }
  return indices;
}

std::vector<scene::LightMode> light_modes(const scene::Scene& scene, bool records) {
  std::vector<scene::LightMode> modes = scene::light_modes(scene);
  const std::vector<std::string> groups = scene::light_groups(scene);
  for (std::size_t g = 0; g < modes.size(); ++g)
    if (!records && !scene::asked_light_mode(scene, groups[g])) modes[g] = scene::LightMode::realtime;
  return modes;
}

std::vector<scene::LightMode> light_modes(const probes::ProbeSet& set) {
  std::vector<scene::LightMode> modes;
  for (const probes::LightGroup& group : set.light_groups) modes.push_back(group.mode);
  return modes;
}

void set_light_modes(const rays::TransportSource& source, probes::ProbeSet& set,
                     std::span<const scene::LightMode> modes, const Control& control,
                     const LightScope& scope) {
  require(modes.size() == set.light_groups.size(), "light modes", "there is not one for each light group");
  scope.require_within(set.probes.size(), set.light_groups.size());
  const std::vector<int> baked = baked_indices(modes);
  if (!baked.empty() && !set.surface)
    throw Error(fmt::format("light mode of \"{}\"", set.light_groups[baked[0]].name),
                "baked light is kept at points of surfaces, and the set has none", "bake it with --records");
  for (std::size_t g = 0; g < modes.size(); ++g) set.light_groups[g].mode = modes[g];
  if (baked.empty()) return;

  std::vector<mat4> poses;
  for (int part = 0; part < source.part_count(); ++part)
    poses.push_back(source.part_pose(part, set.generator.time));
  const auto direct = source.direct_light(source.lights(set.generator.time), poses);
  parallel_for(
      set.probes.size(), 1,
      [&](std::size_t i) {
        probes::Probe& probe = set.probes[i];
        for (const int g : baked) {
          const auto index = static_cast<std::size_t>(g);
          // What is diffuse is the sky, which rays have found
          if (modes[index] != scene::LightMode::baked) continue;
          if (!scope.has_probe(i) || !scope.has_group(index)) continue;
          probe.groups[index].emitted = transport::project_arriving(
              direct->arriving(g, probe.position, transport::arriving_samples), set.degree);
        }
      },
      control);
  probes::merge_groups(set);
}

void adopt_modes(probes::ProbeSet& set, const scene::Scene& scene) {
  for (probes::LightGroup& group : set.light_groups)
    group.mode = scene::asked_light_mode(scene, group.name).value_or(group.mode);
  probes::merge_groups(set);
}

std::string mode_difference(const probes::ProbeSet& set, const scene::Scene& scene) {
  std::string text;
  for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
    const probes::LightGroup& group = set.light_groups[g];
    const scene::LightMode asked = scene::asked_light_mode(scene, group.name).value_or(group.mode);
    if (!scene::keeps_direct(asked) || (set.surface && set.surface->keeps_direct(g))) continue;
    text += fmt::format("{}light group \"{}\" as {}, asked for as {}", text.empty() ? "" : "; ", group.name,
                        name_of(group.mode), name_of(asked));
  }
  return text;
}

std::vector<std::string> blurred_shadows(const scene::Scene& scene) {
  std::vector<std::string> lines;
  for (const scene::GroupMode& asked : scene.light_modes) {
    if (!scene::keeps_direct(asked.mode)) continue;
    const auto sharp = std::ranges::find_if(scene.lights, [&](const scene::Light& light) {
      return scene::light_group(light) == asked.group && casts_sharp_shadows(light);
    });
    if (sharp != scene.lights.end())
      lines.push_back(fmt::format(
          "light group \"{}\" is baked: the sharp shadows of its {} light become as soft as records "
          "are far apart; mixed keeps them",
          asked.group, name_of(sharp->type)));
  }
  return lines;
}

}  // namespace ssphh::bake
