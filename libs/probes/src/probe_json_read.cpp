#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <ssphh/probes/probe_codec.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/probe_limits.h>

#include "probe_finish.h"

namespace ssphh::probes {
namespace {

using json::Cursor;

int integer(const Cursor& at, int least, int most) {
  return static_cast<int>(at.integer(least, most));
}

vec3 vector3(const Cursor& at, double least, double most) {
  at.size(3, 3);
  return {at[0].number(least, most), at[1].number(least, most), at[2].number(least, most)};
}

/// A place in a probe file, whose functions have numbers within limits.
class FilePlace : public Cursor {
 public:
  FilePlace(const Cursor& at) : Cursor(at) {}
  FilePlace operator[](const char* name) const { return Cursor::operator[](name); }
  FilePlace operator[](std::size_t i) const { return Cursor::operator[](i); }

  std::size_t float_count() const { return size(); }
  void vectors(std::span<vec3> out) const {
    const std::span<float> values(out.empty() ? nullptr : &out[0].x, 3 * out.size());
    numbers(values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(std::abs(values[i]) <= limits::coefficient))
        (*this)[i].fail(fmt::format("must be a number of magnitude at most {:g}", limits::coefficient));
    }
  }
};
using FileParts = JsonParts<FilePlace>;

GeneratorInfo read_generator(const Cursor& at) {
  at.members({"operator", "gen", "max_depth", "passes", "spp", "viz", "viz_source", "viz_paths",
              "viz_max_depth", "viz_passes", "viz_spp", "face_size", "seed", "directions", "surfel_size",
              "link_rays", "scene", "scene_hash", "time"});
  GeneratorInfo g;
  g.op = at["operator"].named<LightOperator>();
  g.viz = at["viz"].named<VizMethod>();
  g.gen = at["gen"].named<GenMode>();
  g.max_depth = integer(at["max_depth"], 0, limits::depth);
  g.passes = integer(at["passes"], 1, limits::samples);
  g.spp = integer(at["spp"], 1, limits::samples);
  g.viz_source = at["viz_source"].named<VizSource>();
  g.viz_paths = at["viz_paths"].named<rays::PathSet>();
  g.viz_max_depth = integer(at["viz_max_depth"], 0, limits::depth);
  g.viz_passes = integer(at["viz_passes"], 1, limits::samples);
  g.viz_spp = integer(at["viz_spp"], 1, limits::samples);
  g.face_size = integer(at["face_size"], 1, limits::face_size);
  g.seed = at["seed"].hexadecimal();
  g.directions = integer(at["directions"], 0, limits::rays);
  g.surfel_size = at["surfel_size"].number(0, limits::coordinate);
  g.link_rays = integer(at["link_rays"], 0, limits::rays);
  g.scene = at["scene"].text(limits::text);
  g.scene_hash = at["scene_hash"].hash();
  g.time = at["time"].number(-limits::coordinate, limits::coordinate);
  return g;
}

Probe read_probe(const Cursor& at, const ProbeSet& set, std::size_t index, std::size_t probe_count,
                 bool with_hierarchy) {
  if (with_hierarchy) {
    at.members({"name", "position", "radius", "groups", "edges", "neighbor"});
  } else {
    at.members({"name", "position", "radius", "groups", "edges"});
  }
  Probe probe;
  probe.name = at["name"].text(limits::text);
  probe.position = vector3(at["position"], -limits::coordinate, limits::coordinate);
  probe.radius = at["radius"].number(limits::smallest_radius, limits::coordinate);
  const Cursor groups = at["groups"];
  groups.size(set.light_groups.size(), set.light_groups.size());
  for (std::size_t g = 0; g < set.light_groups.size(); ++g)
    probe.groups.push_back(read_light(FileParts(groups[g]), set.degree));
  probe.edges = read_edges(FileParts(at["edges"]), set.degree, index, probe_count);
  return probe;
}

FittedPoints read_fitted(const Cursor& at, std::size_t probe_count) {
  const std::size_t count = at.size(0, limits::fitted_points);
  FittedPoints fitted;
  fitted.points.resize(count);
  fitted.weights.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Cursor point = at[i].members({"position", "normal", "probes", "weights"});
    fitted.points[i] = {vector3(point["position"], -limits::coordinate, limits::coordinate),
                        vector3(point["normal"], -2, 2)};
    const Cursor probes = point["probes"], weights = point["weights"];
    const std::size_t used = probes.size(0, max_weights);
    weights.size(used, used);
    PointWeights& out = fitted.weights[i];
    for (std::size_t k = 0; k < used; ++k) {
      out.entries[k] = {integer(probes[k], 0, static_cast<int>(probe_count) - 1),
                        weights[k].number(0, limits::fitted_weight)};
    }
    out.count = static_cast<int>(used);
  }
  return fitted;
}

SurfaceRecords read_surface(const Cursor& at, std::size_t group_count) {
  const std::size_t count = at.size(0, limits::surface_records);
  SurfaceRecords surface;
  surface.points.resize(count);
  surface.groups.assign(group_count, std::vector<PackedRecordLight>(count));
  const auto read = [](const Cursor& numbers, PackedRecordLight& light) {
    numbers.size(1 + light.values.size(), 1 + light.values.size());
    light.scale = numbers[0].number(0, limits::coefficient);
    for (std::size_t k = 0; k < light.values.size(); ++k)
      light.values[k] = static_cast<std::int16_t>(integer(numbers[1 + k], -32767, 32767));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Cursor point = at[i].members({"position", "normal", "groups"}, {"direct"});
    surface.points[i] = {vector3(point["position"], -limits::coordinate, limits::coordinate),
                         vector3(point["normal"], -2, 2)};
    const Cursor groups = point["groups"];
    groups.size(group_count, group_count);
    for (std::size_t g = 0; g < group_count; ++g) read(groups[g], surface.groups[g][i]);
    if (!point.has("direct")) continue;
    const Cursor direct = point["direct"];
    direct.size(group_count, group_count);
    surface.direct.resize(group_count);
    for (std::size_t g = 0; g < group_count; ++g) {
      if (direct[g].size() == 0) continue;
      surface.direct[g].resize(count);  // that of points which say nothing is dark
      read(direct[g], surface.direct[g][i]);
    }
  }
  if (std::ranges::all_of(surface.direct, &std::vector<PackedRecordLight>::empty)) surface.direct.clear();
  return surface;
}

Baseline read_baseline(const Cursor& at, std::size_t probe_count, std::size_t group_count) {
  at.members({"neighbors", "threshold", "records", "surfels", "items", "trials"});
  Baseline baseline;
  baseline.viz_neighbors = integer(at["neighbors"], -1, static_cast<int>(limits::probes));
  baseline.viz_threshold = at["threshold"].number(0, limits::coefficient);
  baseline.records = integer(at["records"], 0, static_cast<int>(limits::surface_records));
  baseline.most_surfels = integer(at["surfels"], 0, limits::surfels);
  const Cursor items = at["items"];
  baseline.items.resize(items.size(0, limits::scene_items));
  for (std::size_t i = 0; i < baseline.items.size(); ++i) {
    const Cursor item = items[i].members({"kind", "name", "shape", "place", "surface", "emission"});
    baseline.items[i] = {item["kind"].named<scene::ItemKind>(),
                         item["name"].text(limits::text),
                         item["shape"].hash(),
                         item["place"].hash(),
                         item["surface"].hash(),
                         item["emission"].hash()};
  }
  const Cursor trials = at["trials"];
  if (trials.size(0, probe_count) == 0) return baseline;
  trials.size(probe_count, probe_count);
  for (std::size_t i = 0; i < probe_count; ++i) {
    trials[i].size(2, 2);
    Trial& trial = baseline.trials.emplace_back();
    for (std::size_t half = 0; half < 2; ++half) {
      const Cursor groups = trials[i][half];
      groups.size(group_count, group_count);
      for (std::size_t g = 0; g < group_count; ++g) {
        const FilePlace at_light(groups[g]);
        sh::RadianceSh& light = trial.halves[half].emplace_back(trial_degree);
        at_light.size(3 * light.values.size(), 3 * light.values.size());
        at_light.vectors(light.values);
      }
    }
  }
  return baseline;
}

ProbeSet read_set(const Cursor& root) {
  if (root.has("version")) root["version"].expect_version(probe_file_version);
  root.members({"format", "version", "degree", "generator", "light_groups", "probes"},
               {"hierarchy", "fitted", "surface", "baseline"});
  if (root["format"].text(limits::text) != "ssphh-probes") root["format"].fail("must be \"ssphh-probes\"");
  ProbeSet set;
  set.degree = integer(root["degree"], 0, sh::max_degree);
  set.generator = read_generator(root["generator"]);
  const Cursor groups = root["light_groups"];
  const std::size_t group_count = groups.size(0, limits::light_groups);
  for (std::size_t g = 0; g < group_count; ++g) {
    const Cursor at = groups[g].members({"name", "scale", "mode"});
    set.light_groups.push_back({at["name"].text(limits::text), vector3(at["scale"], 0, limits::scale),
                                at["mode"].named<scene::LightMode>()});
  }
  if (root.has("hierarchy")) {
    const Cursor at = root["hierarchy"].members({"operator", "neighbors", "threshold"});
    Hierarchy& h = set.hierarchy.emplace();
    h.op = at["operator"].named<HierOperator>();
    h.neighbors = integer(at["neighbors"], -1, static_cast<int>(limits::probes));
    h.threshold = at["threshold"].number(0, limits::coefficient);
  }
  const Cursor probes = root["probes"];
  const std::size_t probe_count = probes.size(0, limits::probes);
  const auto coefficients = static_cast<std::size_t>(sh::coefficient_count(set.degree));
  for (std::size_t i = 0; i < probe_count; ++i) {
    set.probes.push_back(read_probe(probes[i], set, i, probe_count, set.hierarchy.has_value()));
    if (!set.hierarchy) continue;
    set.hierarchy->neighbor.emplace_back().values =
        FileParts(probes[i]).vectors("neighbor", coefficients, Missing::never);
  }
  if (root.has("fitted")) set.fitted = read_fitted(root["fitted"], probe_count);
  if (root.has("surface")) set.surface = read_surface(root["surface"], group_count);
  if (root.has("baseline")) set.baseline = read_baseline(root["baseline"], probe_count, group_count);
  return set;
}

/// Of nesting, and of containers, which cost far more memory than text.
constexpr json::Limits document_limits{
    .bytes = limits::json_bytes, .depth = 8, .containers = std::size_t{1} << 21};

}  // namespace

ProbeSet probes_from_json(std::string_view text, const std::string& where) {
  const json::Value document = json::parse(text, where, document_limits);
  ProbeSet set = read_set(Cursor(document, where));
  finish_reading(set, where);
  return set;
}

}  // namespace ssphh::probes
