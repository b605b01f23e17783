#include <algorithm>

#include <fmt/format.h>

#include <ssphh/cook/cook.h>
#include <ssphh/core/counted.h>
#include <ssphh/probes/fitted_surfaces.h>
#include <ssphh/sh/evaluate.h>

#include "group_light.h"
#include "other_places.h"
#include "parts.h"

namespace ssphh::cook {
namespace {

using Irradiance = std::vector<std::vector<sh::IrradianceSh>>;  // [group][probe]

/// As the format knows it: `diffuse` is baked where records keep the group's direct light, else realtime.
std::uint32_t mode_of(const probes::LightGroup& group, const std::vector<std::string>& mirrored) {
  if (group.mode != scene::LightMode::diffuse) return static_cast<std::uint32_t>(group.mode);
  const bool kept = std::ranges::find(mirrored, group.name) != mirrored.end();
  return static_cast<std::uint32_t>(kept ? scene::LightMode::baked : scene::LightMode::realtime);
}

void add_groups(Sections& out, const probes::ProbeSet& set) {
  const std::vector<std::string> mirrored = probes::mirrored_groups(set);
  out.header.group_count = static_cast<std::uint32_t>(set.light_groups.size());
  std::uint32_t at = 0;
  for (const probes::LightGroup& group : set.light_groups) {
    const auto length = static_cast<std::uint32_t>(group.name.size());
    const vec3& s = group.scale;
    out.append(SSPHH_COOKED_GROUPS,
               ssphh_cooked_group{at, length, {s.x, s.y, s.z}, mode_of(group, mirrored), {0, 0}});
    out.append(SSPHH_COOKED_NAMES, std::span<const char>(group.name.c_str(), length + 1));
    at += length + 1;
  }
}

constexpr std::size_t to_band_3 = 9, to_band_4 = 16;

/// Channel after channel, bands 0, 1, 2 and 4, then zeros.
void add_probe_light(Sections& out, const sh::IrradianceSh& light) {
  std::vector<float> channel(out.header.probe_stride, 0.0f);
  for (glm::length_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < light.values.size(); ++k) {
      if (k < to_band_3 || k >= to_band_4)
        channel[k < to_band_3 ? k : k - to_band_4 + to_band_3] = light.values[k][c];
    }
    out.append(SSPHH_COOKED_LIGHT, std::span<const float>(channel));
  }
}

/// With direct light, where the group's mode keeps it.
void add_record_light(Sections& out, const probes::SurfaceRecords& records, std::size_t group,
                      scene::LightMode mode) {
  const bool direct = scene::keeps_direct(mode) && records.keeps_direct(group);
  for (std::size_t i = 0; i < records.points.size(); ++i) {
    probes::RecordLight light = unpack(records.groups[group][i], records.points[i].normal);
    if (direct) light += unpack(records.direct[group][i], records.points[i].normal);
    out.append(SSPHH_COOKED_LIGHT, light);
  }
}

/// Bands 0 to 2, and what the rest adds at the point's own normal.
void add_fitted_light(Sections& out, const probes::FittedSurfaces& fitted,
                      const std::vector<sh::IrradianceSh>& light, int degree) {
  constexpr std::size_t kept = to_band_3;
  std::vector<float> basis(static_cast<std::size_t>(sh::coefficient_count(degree)));
  for (std::size_t i = 0; i < fitted.weights.size(); ++i) {
    sh::eval_basis(degree, fitted.surfaces.points[i].normal, basis);
    std::array<float, SSPHH_COOKED_FITTED_FLOATS> values{};
    for (const probes::ProbeWeight& weight : fitted.weights[i].used()) {
      const std::vector<vec3>& e = light[weight.probe].values;
      for (std::size_t k = 0; k < e.size(); ++k) {
        const vec3 part = weight.weight * (k < kept ? e[k] : basis[k] * e[k]);
        for (std::size_t c = 0; c < 3; ++c)
          values[3 * std::min(k, kept) + c] += part[static_cast<glm::length_t>(c)];
      }
    }
    out.append(SSPHH_COOKED_LIGHT, values);
  }
}

/// What stands on surfaces: records, or fitted points, or nothing.
struct OnSurfaces {
  const probes::SurfaceRecords* records = nullptr;
  probes::FittedSurfaces fitted;
};

OnSurfaces prepare(Sections& out, const probes::ProbeSet& set, const CookScene& scene,
                   const rays::PosedWorld& world, const Control& control) {
  OnSurfaces found;
  const float time = set.generator.time;
  const auto sees = [&](const vec3& a, const vec3& b) { return world.visible(a, b); };
  const auto joined = [&](const vec3& a, const vec3& b) { return world.joined(a, b); };
  const probes::WeightMethod chosen = probes::chosen_weights(set, {});
  if (chosen == probes::WeightMethod::surface) {
    const probes::SurfaceLists lists =
        probes::prepare_surfaces(scene.scene, time, set.surface->points, joined, control);
    if (lists.empty()) return found;
    found.records = &*set.surface;
    out.header.point_floats = SSPHH_COOKED_RECORD_FLOATS;
    add_points(out, lists);
  } else if (chosen == probes::WeightMethod::fitted) {
    found.fitted = prepare_fitted(scene.scene, time, *set.fitted, sees, control);
    if (found.fitted.empty()) return found;
    out.header.point_floats = SSPHH_COOKED_FITTED_FLOATS;
    add_points(out, found.fitted.surfaces);
  }
  return found;
}

std::vector<std::string> lost(const probes::ProbeSet& set, const Sections& sections, const CookScene* scene) {
  std::vector<std::string> lines;
  const auto say = [&](bool whether, std::string line) {
    if (whether) lines.push_back(std::move(line));
  };
  const auto degree = static_cast<int>(sections.header.degree);
  say(!scene, "what hides what: without --scene every probe counts as seen, and light passes through walls");
  say(set.degree > degree,
      fmt::format("bands {} to {} of the probes' light: reflections", degree + 1, set.degree));
  const bool points = set.surface ? !set.surface->points.empty() : set.fitted.has_value();
  say(points && sections.header.point_count == 0,
      set.hierarchy ? "points of surfaces: they do not hold the hierarchy's light"
                    : "points of surfaces: they need --scene");
  say(set.fitted && sections.header.point_floats == SSPHH_COOKED_RECORD_FLOATS,
      "fitted weights: records serve surfaces");
  say(probes::edge_count(set) > 0,
      counted(probes::edge_count(set), "edge between probes", "edges between probes"));
  say(set.baseline.has_value(), "what bake --update compares a scene with");
  return lines;
}

}  // namespace

Cooked cook(const probes::ProbeSet& set, const CookScene* scene, const CookParams& params,
            const Control& control) {
  if (params.places) {
    require(scene != nullptr, "cook", "places of another set need a scene");
    const rays::PosedWorld world(scene->source, set.generator.time);
    const probes::ProbeSet moved = at_places_of(
        *params.places, set, [&](const vec3& a, const vec3& b) { return world.joined(a, b); }, control);
    CookParams own = params;
    own.places = nullptr;
    return cook(moved, scene, own, control);
  }
  require(params.sight_size == 0 || (params.sight_size >= 8 && params.sight_size <= 256), "cook",
          "texels of sight must be 0 or 8 to 256");
  if (set.probes.size() > 65535)
    throw Error("cook", fmt::format("there are {} probes, at most 65535 can be cooked", set.probes.size()));
  Sections out;
  ssphh_cooked_header& h = out.header;
  const int wanted = probes::irradiance_degree({}, set.degree), degree = wanted == 3 ? 2 : wanted;
  const Irradiance light = group_irradiance(set, degree);
  h.scene[0] = set.generator.scene_hash.high, h.scene[1] = set.generator.scene_hash.low;
  h.time = set.generator.time;
  h.degree = static_cast<std::uint32_t>(degree);
  h.probe_stride =
      static_cast<std::uint32_t>(((degree == 4 ? 18 : sh::coefficient_count(degree)) + 7) / 8 * 8);
  add_groups(out, set);

  std::optional<rays::PosedWorld> world;
  if (scene) world.emplace(scene->source, set.generator.time);
  add_probes(out, set, world ? &*world : nullptr, params, control);
  OnSurfaces on_surfaces;
  if (scene) on_surfaces = prepare(out, set, *scene, *world, control);

  for (std::size_t g = 0; g < light.size(); ++g) {
    for (const sh::IrradianceSh& probe : light[g]) add_probe_light(out, probe);
    if (on_surfaces.records) add_record_light(out, *on_surfaces.records, g, set.light_groups[g].mode);
    add_fitted_light(out, on_surfaces.fitted, light[g], degree);
  }

  Cooked cooked;
  const auto bytes = [&](int section) { return out.bytes[section].size(); };
  cooked.points = h.point_count, cooked.cells = h.cell_count, cooked.entries = h.entry_count;
  cooked.sight_bytes = bytes(SSPHH_COOKED_SIGHT), cooked.light_bytes = bytes(SSPHH_COOKED_LIGHT);
  cooked.list_bytes = bytes(SSPHH_COOKED_BRICKS) + bytes(SSPHH_COOKED_CELLS) + bytes(SSPHH_COOKED_ENTRIES) +
                      bytes(SSPHH_COOKED_MASKS) + bytes(SSPHH_COOKED_POINTS) +
                      bytes(SSPHH_COOKED_PROBE_CELLS);
  cooked.lost = lost(set, out, scene);
  cooked.bytes = file_of(out);
  return cooked;
}

}  // namespace ssphh::cook
