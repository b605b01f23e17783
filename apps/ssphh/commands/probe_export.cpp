#include "commands/probe_export.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/file.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/probes/keyed_files.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/trace/transport_scene.h>

#include "commands/command.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

float spacing_of(const std::string& grid) {
  if (grid == "auto") return 0;
  const std::optional<float> metres = parse_number<float>(grid);
  if (!metres || !(*metres > 0) || !std::isfinite(*metres))
    throw Error("--grid " + grid, "is neither auto nor a length in metres", "write 0.5, for instance");
  return *metres;
}

/// One, or those of keys by their time.
std::vector<probes::KeyedSet> sets_of(const std::string& input) {
  const std::vector<probes::ProbeKey> keys = probes::read_probe_keys(input);
  if (keys.size() > 1) return probes::read_keyed_sets(keys);
  probes::ProbeSet set = probes::read_probe_file(keys.front().file);
  const float time = set.generator.time;
  return {{time, std::move(set)}};
}

std::string without_ending(std::string name, std::string_view ending) {
  if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  return name;
}

/// What a file's name may hold of a group's.
std::string plain(const std::string& group) {
  std::string name;
  for (const char c : group) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    name += fits ? c : '_';
  }
  return name;
}

std::vector<std::string> groups_of(const ProbeExportOptions& o, const probes::ProbeSet& set) {
  std::vector<std::string> groups = o.group;
  if (o.groups == GroupFiles::separate) {
    for (const probes::LightGroup& group : set.light_groups) groups.push_back(group.name);
  }
  std::set<std::string> names;
  for (const std::string& group : groups) {
    if (!names.insert(plain(group)).second)
      throw Error("light group " + group, "its file would have the name of another group's",
                  "export them one by one with --group");
  }
  return groups;
}

void check(const ProbeExportOptions& o, const probe_export::Target& target) {
  const auto need = [](const std::string& value, const char* option) {
    if (value.empty())
      throw Error("probe export", fmt::format("{} is missing", option), "see --help, or --list");
  };
  need(o.input, "FILE"), need(o.scene.source, "--scene"), need(o.output, "--output");
  if (!target.grid && o.grid != "auto")
    throw Error(fmt::format("--to {}", target.name), "has no grid: the probes themselves are written",
                "leave out --grid");
}

}  // namespace

ProbeExportResult run_probe_export(const ProbeExportOptions& o, const Control& control) {
  if (o.list) return {};
  const probe_export::Target& target = probe_export::find_target(o.to);
  check(o, target);
  const float spacing = spacing_of(o.grid);
  const std::vector<probes::KeyedSet> sets = sets_of(o.input);
  const bool keyed = sets.size() > 1;
  const scene::Scene scene = load_lit_scene(o.scene);
  const trace::TransportScene rays(scene);
  for (const probes::KeyedSet& key : sets)
    require_same_scene(o.input, key.set, scene, rays.light_groups(), {}, o.force);

  const probes::ProbeLight part = o.emitted ? probes::ProbeLight::all : probes::ProbeLight::reflected;
  probe_export::GridParams grid;
  grid.spacing = spacing;
  // Of the first pose for all, so that an engine can blend them number by number
  std::optional<probe_export::GridShape> shape;
  if (keyed && target.grid) {
    const probes::ProbeSet& first = sets.front().set;
    shape = probe_export::fit_grid(first, probe_export::FreeLight(first, rays, part), grid);
  }
  const std::string stem = without_ending(o.output, target.ending);
  ProbeExportResult result;
  const auto write = [&](const probes::ProbeSet& light, const std::string& path) {
    const probe_export::ExportSource source{light, rays, part, grid, shape};
    const probe_export::Exported exported =
        target.write(source, std::filesystem::path(path).filename().string(), control);
    for (const probe_export::ExportFile& file : exported.files) {
      const std::string name =
          (file.shared ? stem : path) + (file.ending.empty() ? std::string(target.ending) : file.ending);
      if (file.shared && std::ranges::find(result.files, name) != result.files.end()) continue;
      result.files.push_back(name);
      result.bytes += file.data.size();
      write_file(result.files.back(), file.data);
    }
    result.points = exported.points, result.filled = exported.filled, result.notes = exported.notes;
    result.lost = probe_export::lost(light, target, keyed);
  };
  const std::vector<std::string> groups = groups_of(o, sets.front().set);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const std::string path = keyed ? fmt::format("{}-key{}", stem, k) : stem;
    if (keyed) result.key_times.push_back(sets[k].time);
    for (const std::string& group : groups)
      write(probe_export::only_group(sets[k].set, group), path + "-" + plain(group));
    if (groups.empty()) write(sets[k].set, path);
  }
  return result;
}

json::Value to_json(const ProbeExportResult& result, const ProbeExportOptions& o) {
  if (o.list) {
    json::Value list = json::Value::array();
    for (const probe_export::Target& t : probe_export::targets()) {
      list.push_back({{"name", t.name},
                      {"about", t.about},
                      {"carries", t.carries},
                      {"loses", t.loses},
                      {"ending", t.ending}});
    }
    return {{"targets", std::move(list)}};
  }
  return {{"to", o.to},
          {"files", result.files},
          {"points", result.points},
          {"filled", result.filled},
          {"bytes", result.bytes},
          {"key_times", result.key_times},
          {"lost", result.lost},
          {"notes", result.notes}};
}

std::string to_text(const ProbeExportResult& result, const ProbeExportOptions& o) {
  std::string text;
  if (o.list) {
    for (const probe_export::Target& t : probe_export::targets()) {
      text += fmt::format("{}{}: {}\n  carries  {}\n  loses    {}", text.empty() ? "" : "\n", t.name, t.about,
                          t.carries, t.loses);
    }
    return text;
  }
  for (const std::string& file : result.files) text += file + "\n";
  text += fmt::format("{} points ({} within bodies, out of sight or added: light of neighbours), {} bytes",
                      result.points, result.filled, result.bytes);
  if (!result.key_times.empty())
    text += fmt::format("\nkeys 0 to {}: light at {:g} s", result.key_times.size() - 1,
                        fmt::join(result.key_times, ", "));
  for (const std::string& line : result.notes) text += "\nnote: " + line;
  for (const std::string& line : result.lost) text += "\nnot carried: " + line;
  return text;
}

void add_probe_export_command(Command group, Context& context) {
  auto [command, o] =
      add_command(group, context, "export", "Write a probe file's light for an engine", run_probe_export);
  add_probe_keys(
      command, "FILE", o.input,
      "Probe file; several, as a.sphl@0,b.sphl@1, are keys of light that moves: OUT-key0, OUT-key1 "
      "…, grids of the same cells");
  add_scene_options(command, o.scene, false, "--scene");
  command["--scene"].required(false);
  std::vector<std::string> names;
  for (const probe_export::Target& target : probe_export::targets()) names.emplace_back(target.name);
  command.option("--to", o.to, "Engine or format").one_of(names);
  command.option("-o,--output", o.output, "File to write; the format's ending is added");
  command.option("--grid", o.grid,
                 "Metres between the points of a grid, where the format has one; auto: some 8,000 points");
  const Option some =
      command.option("--group", o.group, "Write this light group alone, to OUT-GROUP").repeatable();
  command.choice("--groups", o.groups, "One file of all light groups, or a file for each, OUT-GROUP")
      .excludes(some);
  command.flag("--emitted", o.emitted,
               "With light straight from emitters that probes see, for an engine that lacks these lamps");
  command.flag("--list", o.list, "Tell what each format carries and loses");
  add_force_option(command, o.force);
  command.footer(
      "Grids are resampled from this project's lookup, which knows what hides what; points within bodies or "
      "out of\n"
      "all probes' sight take the light of neighbours. Only indirect light is written, unless --emitted or a "
      "light\n"
      "group's mode says otherwise. FILE, --scene, --to and --output are needed unless --list is given.");
}

}  // namespace ssphh::app
