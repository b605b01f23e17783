#include "commands/probe.h"

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/image/io.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>

#include "commands/command.h"
#include "options/probe_options.h"
#include "results/json_values.h"

namespace ssphh::app {
namespace {

std::string rgb_text(const vec3& v) {
  return fmt::format("{:9.4g} {:9.4g} {:9.4g}", v.x, v.y, v.z);
}

/// Lowest E(n) of any channel over all normals.
float lowest_irradiance(const sh::RadianceSh& light) {
  const vec3 lowest = sh::minimum(sh::irradiance_from_radiance(light));
  return std::min({lowest.x, lowest.y, lowest.z});
}

json::Value generator_json(const probes::GeneratorInfo& g) {
  return {{"operator", name_of(g.op)},
          {"gen", name_of(g.gen)},
          {"max_depth", g.max_depth},
          {"passes", g.passes},
          {"spp", g.spp},
          {"viz", name_of(g.viz)},
          {"viz_source", name_of(g.viz_source)},
          {"viz_paths", name_of(g.viz_paths)},
          {"viz_max_depth", g.viz_max_depth},
          {"viz_passes", g.viz_passes},
          {"viz_spp", g.viz_spp},
          {"face_size", g.face_size},
          {"seed", g.seed},
          {"directions", g.directions},
          {"surfel_size", g.surfel_size},
          {"link_rays", g.link_rays},
          {"scene", g.scene},
          {"scene_hash", g.scene_hash.hex()},
          {"time", g.time}};
}

json::Value probe_json(const ProbeInfo& info, std::size_t i) {
  const probes::ProbeSet& set = info.set;
  const probes::Probe& probe = set.probes[i];
  json::Value groups = json::Value::array(), edges = json::Value::array();
  for (const probes::GroupLight& group : probe.groups) {
    groups.push_back(
        {{"emitted", to_json(sh::mean(group.emitted))}, {"reflected", to_json(sh::mean(group.reflected))}});
  }
  for (const probes::Edge& edge : probe.edges) {
    edges.push_back(
        {{"from", edge.from}, {"transfer", edge.transfer}, {"matrix", !edge.matrix.values.empty()}});
  }
  json::Value object = {{"name", probe.name},
                        {"position", to_json(probe.position)},
                        {"radius", probe.radius},
                        {"mean", to_json(sh::mean(probe.self))},
                        {"reflected_mean", to_json(sh::mean(probe.reflected))},
                        {"min_irradiance", info.lowest_irradiance[i]},
                        {"groups", groups},
                        {"edges", edges}};
  if (set.hierarchy) object["neighbor_mean"] = to_json(sh::mean(set.hierarchy->neighbor[i]));
  return object;
}

std::string probe_text(const ProbeInfo& info, std::size_t i) {
  const probes::ProbeSet& set = info.set;
  const probes::Probe& probe = set.probes[i];
  std::string text =
      fmt::format("\n{:3}  {}  at ({:.4g}, {:.4g}, {:.4g}) m, radius {:.3g} m\n", i, probe.name,
                  probe.position.x, probe.position.y, probe.position.z, probe.radius);
  text += fmt::format("     self       {}   lowest irradiance {:.4g}\n", rgb_text(sh::mean(probe.self)),
                      info.lowest_irradiance[i]);
  for (std::size_t g = 0; g < probe.groups.size(); ++g) {
    const probes::GroupLight& group = probe.groups[g];
    text += fmt::format("     reflected  {}   {}\n", rgb_text(sh::mean(group.reflected)),
                        set.light_groups[g].name);
    if (!group.emitted.empty()) {
      text += fmt::format("     emitted    {}   {}\n", rgb_text(sh::mean(group.emitted)),
                          set.light_groups[g].name);
    }
  }
  if (set.hierarchy)
    text += fmt::format("     neighbours {}\n", rgb_text(sh::mean(set.hierarchy->neighbor[i])));
  text += "     P";
  for (const probes::Edge& edge : probe.edges) text += fmt::format("  {}: {:.4g}", edge.from, edge.transfer);
  return text + (probe.edges.empty() ? "  no edges" : "");
}

}  // namespace

ProbeInfo run_probe_info(const ProbeInfoOptions& options, const Control&) {
  ProbeInfo info{probes::read_probe_file(options.input), probes::packing_of_file(options.input), {}};
  for (const probes::Probe& probe : info.set.probes)
    info.lowest_irradiance.push_back(lowest_irradiance(probe.self));
  return info;
}

json::Value to_json(const ProbeInfo& info, const ProbeInfoOptions& options) {
  const probes::ProbeSet& set = info.set;
  json::Value groups = json::Value::array(), probes = json::Value::array();
  for (const probes::LightGroup& group : set.light_groups)
    groups.push_back({{"name", group.name}, {"scale", to_json(group.scale)}, {"mode", name_of(group.mode)}});
  for (std::size_t i = 0; i < set.probes.size(); ++i) probes.push_back(probe_json(info, i));
  json::Value object = {{"file", options.input},
                        {"degree", set.degree},
                        {"pack", name_of(info.packing)},
                        {"generator", generator_json(set.generator)},
                        {"light_groups", std::move(groups)},
                        {"edges", probes::edge_count(set)},
                        {"fitted", set.fitted ? set.fitted->points.size() : 0},
                        {"records", set.surface ? set.surface->points.size() : 0}};
  if (set.hierarchy) {
    const probes::Hierarchy& h = *set.hierarchy;
    object["hierarchy"] = {
        {"operator", name_of(h.op)}, {"neighbors", h.neighbors}, {"threshold", h.threshold}};
  }
  object["probes"] = std::move(probes);
  return object;
}

std::string to_text(const ProbeInfo& info, const ProbeInfoOptions& options) {
  const probes::ProbeSet& set = info.set;
  const probes::GeneratorInfo& g = set.generator;
  std::string text = fmt::format(
      "{}: {} of degree {}, {}{}\nscene {} at {} s; light by {}, edges by {}\n", options.input,
      counted(set.probes.size(), "probe"), set.degree,
      info.packing == sh::Packing::none ? "" : fmt::format("packed as {}, ", name_of(info.packing)),
      counted(probes::edge_count(set), "edge"), g.scene, g.time, name_of(g.op), name_of(g.viz));
  const bool gen = g.op == probes::LightOperator::path, viz = g.viz == probes::VizMethod::path;
  if (gen)
    text += fmt::format("GEN {}: paths of depth {}, {} x {} samples\n", name_of(g.gen), g.max_depth, g.passes,
                        g.spp);
  if (viz)
    text += fmt::format("VIZ: {} paths of depth {}, {} x {} samples\n", name_of(g.viz_paths), g.viz_max_depth,
                        g.viz_passes, g.viz_spp);
  if (gen || viz) text += fmt::format("{0}x{0}x6 texels, seed {1}\n", g.face_size, g.seed);
  if (g.viz != probes::VizMethod::none) text += fmt::format("P of SPHLs of {} 1\n", name_of(g.viz_source));
  if (g.directions > 0) {
    text += fmt::format("transport: {} directions a probe, surfels of {:.3g} m, {} link rays\n", g.directions,
                        g.surfel_size, g.link_rays);
  }
  if (set.surface)
    text += fmt::format("light kept at {}\n", counted(set.surface->points.size(), "surface point"));
  if (set.fitted)
    text += fmt::format("weights fitted at {}\n", counted(set.fitted->points.size(), "surface point"));
  for (const probes::LightGroup& group : set.light_groups) {
    text += fmt::format("light group {}, scale {:g} {:g} {:g}, {}\n", group.name, group.scale.x,
                        group.scale.y, group.scale.z, name_of(group.mode));
  }
  if (set.hierarchy) {
    const probes::Hierarchy& h = *set.hierarchy;
    text += fmt::format("HIER {}, neighbors {}, threshold {:g}\n", name_of(h.op),
                        h.neighbors < 0 ? "all" : std::to_string(h.neighbors), h.threshold);
  }
  text += "mean radiance R, G, B [W/sr/m2] over all directions:";
  for (std::size_t i = 0; i < set.probes.size(); ++i) text += probe_text(info, i);
  return text;
}

ProbePreviewResult run_probe_preview(const ProbePreviewOptions& options, const Control&) {
  ProbePreviewResult result{probes::read_probe_file(options.input), {}};
  result.sheet = options.edges.empty()
                     ? probe_sheet(result.set, options.width, options.exposure)
                     : edge_sheet(result.set, options.edges, options.width, options.exposure);
  image::write_image(options.output, result.sheet.image);
  return result;
}

json::Value to_json(const ProbePreviewResult& result, const ProbePreviewOptions& options) {
  json::Value columns = json::Value::array(), rows = json::Value::array();
  for (const ProbeSheet::Column& column : result.sheet.columns)
    columns.push_back({{"layer", column.name}, {"exposure", column.exposure}});
  for (const std::string& name : result.sheet.rows) rows.push_back(name);
  return {{"output", options.output},
          {"width", result.sheet.image.width},
          {"height", result.sheet.image.height},
          {"columns", std::move(columns)},
          {"rows", std::move(rows)}};
}

std::string to_text(const ProbePreviewResult& result, const ProbePreviewOptions& options) {
  const ProbeSheet& sheet = result.sheet;
  std::string text = fmt::format("{}: {} x {} pixels, one row per {}, columns from the left:", options.output,
                                 sheet.image.width, sheet.image.height,
                                 options.edges.empty() ? "probe" : "neighbour of " + options.edges);
  for (const ProbeSheet::Column& column : sheet.columns)
    text += fmt::format(" {} (exposure {:+.2f} EV)", column.name, column.exposure);
  if (!result.set.hierarchy) text += "\nrun `ssphh hier` on the file for the neighbours' part and the sum";
  return text;
}

void add_probe_commands(Command app, Context& context) {
  Command group = add_group(app, "probe", "Look at probe files, check and convert them");

  auto [info, listed] =
      add_command(group, context, "info", "List probes, light groups and the hierarchy", run_probe_info);
  add_probe_file(info, "FILE", listed.input, "Probe file").required();

  auto [preview, look] =
      add_command(group, context, "preview",
                  "Draw what each probe sees: itself, its neighbours' part, the sum", run_probe_preview);
  add_probe_file(preview, "FILE", look.input, "Probe file").required();
  preview.option("-o,--output", look.output, "Picture to write: .png .jpg .exr .hdr").required();
  preview.option("--width", look.width, "Pixels of one equirectangular picture, twice its height")
      .range(8, 2048);
  preview.option("--exposure", look.exposure, "EV added to the automatic exposure").range(-60.0, 60.0);
  preview
      .option("--edges", look.edges,
              "Draw how this probe's sum comes about: a row for each neighbour that HIER took")
      .kind("PROBE");
  preview.footer(
      "One row per probe in the file's order. Columns: self, neighbour, sum (self and sum share an "
      "exposure). Each picture\n"
      "is equirectangular: +y on top, +x in the middle. Negative lobes are black. With --edges: S of the "
      "probe, "
      "H of the\n"
      "edge, S of the neighbour, their product H x S, and what S and the products so far sum up to.");

  add_probe_convert_command(group, context);
  add_probe_blend_command(group, context);
  add_probe_import_command(group, context);
  add_probe_lint_command(group, context);
  add_probe_export_command(group, context);
}

}  // namespace ssphh::app
