#include "commands/probe_import.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/query.h>
#include <ssphh/sh/project.h>

#include "commands/command.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

/// Throws Error where a number is no light.
image::Image read_light(const std::string& file) {
  image::Image picture = image::read_image(file);
  if (picture.channels < 3) throw Error(file, "is grey", "light needs three channels");
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const vec3 color = picture.rgb(x, y);
      if (is_finite(color) && glm::all(glm::greaterThanEqual(color, vec3(0)))) continue;
      throw Error(
          file,
          fmt::format("has radiance {:g}, {:g}, {:g} at pixel ({}, {})", color.x, color.y, color.z, x, y),
          "light is finite and not negative; render it without filters that ring");
    }
  }
  return picture;
}

image::CubeMap read_cube(const std::vector<std::string>& files, std::optional<image::Layout> layout,
                         const Control& control) {
  std::vector<image::Image> pictures;
  for (const std::string& file : files) pictures.push_back(read_light(file));
  try {
    if (layout) return image::to_cube(pictures[0], *layout, 0, control);
    return image::cube_of_views(pictures);
  } catch (const Error& e) {
    throw Error(files[0], e.problem(), e.hint());
  }
}

sh::RadianceSh light_of(const image::CubeMap& cube, int degree) {
  sh::CubeFaces faces;
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = cube.faces[f].pixels;
  return sh::project_cube(degree, cube.size, faces, cube.faces[0].channels);
}

void check_options(const ProbeImportOptions& o) {
  const auto check = [&](const char* what, const std::vector<std::string>& files) {
    if (o.layout && files.size() != 1)
      throw Error(what, fmt::format("{} pictures are given, but a layout is of one", files.size()),
                  "give one, or leave out --layout for the six faces of `ssphh export --projection cube`");
    if (!o.layout && files.size() != 6)
      throw Error(what, fmt::format("{} given", counted(files.size(), "picture is", "pictures are")),
                  "one picture of the whole sphere needs --layout; without, it takes the six faces of `ssphh "
                  "export --projection cube`, +X -X +Y -Y +Z -Z");
  };
  check("IMAGE", o.images);
  if (o.emitted.empty()) return;
  check("--emitted", o.emitted);
  if (o.part != LightPart::reflected)
    throw Error("--emitted", "is taken off pictures for the part `reflected`", "leave out --part");
  if (!o.viz_from.empty())
    throw Error("--emitted", "is not for --viz-from", "the sphere that shines belongs to the picture");
}

probes::ProbeSet set_to_fill(const ProbeImportOptions& o) {
  if (o.into.empty() == o.scene.source.empty())
    throw Error("probe import", "needs either --into or --scene",
                "--scene starts a set of the scene's SPHLs, --into goes on with it");
  if (!o.into.empty()) return probes::read_probe_file(o.into);
  const scene::Scene scene = pipeline::load_scene(o.scene);
  probes::ProbeSet set = place::init_from_scene(scene, o.degree, o.scene.time);
  set.light_groups.clear();
  for (probes::Probe& probe : set.probes) probe.groups.clear();
  return set;
}

std::size_t probe_named(const probes::ProbeSet& set, const char* option, const std::string& name) {
  const auto found = std::ranges::find(set.probes, name, &probes::Probe::name);
  if (found != set.probes.end()) return static_cast<std::size_t>(found - set.probes.begin());
  std::vector<std::string> names;
  for (const probes::Probe& probe : set.probes) names.push_back(probe.name);
  if (names.size() > 20) names.resize(20);
  throw Error(option, fmt::format("there is no probe \"{}\"", name),
              fmt::format("the set has: {}", fmt::join(names, ", ")));
}

std::size_t group_named(probes::ProbeSet& set, const std::string& name) {
  const auto found = std::ranges::find(set.light_groups, name, &probes::LightGroup::name);
  const auto index = static_cast<std::size_t>(found - set.light_groups.begin());
  if (found == set.light_groups.end()) set.light_groups.push_back({.name = name});
  for (probes::Probe& probe : set.probes)
    probe.groups.resize(set.light_groups.size(), probes::GroupLight{{}, sh::RadianceSh(set.degree)});
  return index;
}

/// What the other probe's sphere gives at this one: H and P, in place of what the set had.
void set_edge(probes::ProbeSet& set, std::size_t probe, const ProbeImportOptions& o, sh::RadianceSh h) {
  const std::size_t from = probe_named(set, "--viz-from", o.viz_from);
  if (from == probe)
    throw Error("--viz-from " + o.viz_from, "is the probe itself",
                "P of a probe with itself is 1 by meaning");
  if (probes::edge_count(set) > 0 && set.generator.viz_source != o.viz_source)
    throw Error("--viz-source " + std::string(name_of(o.viz_source)),
                fmt::format("is not that of the set's edges, {}", name_of(set.generator.viz_source)));
  set.generator.viz = probes::VizMethod::path;
  set.generator.viz_source = o.viz_source;
  std::vector<probes::Edge>& edges = set.probes[probe].edges;
  std::erase_if(edges, [&](const probes::Edge& edge) { return edge.from == static_cast<int>(from); });
  const float transfer = probes::transfer_coefficient(h);
  if (transfer <= 0) return;
  edges.push_back({static_cast<int>(from), transfer, std::move(h), {}});
  std::ranges::sort(edges, {}, &probes::Edge::from);
}

/// P of the edge; 0 where there is none, as nothing arrived.
float transfer_of(const ProbeImportResult& result, const ProbeImportOptions& o) {
  for (const probes::Edge& edge : result.set.probes[static_cast<std::size_t>(result.probe)].edges)
    if (result.set.probes[static_cast<std::size_t>(edge.from)].name == o.viz_from) return edge.transfer;
  return 0;
}

void set_light(probes::ProbeSet& set, std::size_t probe, const ProbeImportOptions& o, sh::RadianceSh light,
               const Control& control) {
  const std::size_t group = group_named(set, o.group);
  probes::GroupLight& target = set.probes[probe].groups[group];
  if (!o.emitted.empty()) {
    target.emitted = light_of(read_cube(o.emitted, o.layout, control), set.degree);
    for (std::size_t k = 0; k < light.values.size(); ++k) light.values[k] -= target.emitted.values[k];
  }
  (o.part == LightPart::reflected ? target.reflected : target.emitted) = std::move(light);
  if (set.surface)
    log_warning("{}: the light of its surface records is left out: it is another's than the picture's",
                o.output);
  set.surface.reset(), set.baseline.reset();
  probes::merge_groups(set);
}

}  // namespace

ProbeImportResult run_probe_import(const ProbeImportOptions& o, const Control& control) {
  check_options(o);
  ProbeImportResult result{set_to_fill(o)};
  probes::ProbeSet& set = result.set;
  const std::size_t probe = probe_named(set, "--sphl", o.sphl);
  const image::CubeMap cube = read_cube(o.images, o.layout, control);
  sh::RadianceSh light = light_of(cube, set.degree);
  if (o.viz_from.empty())
    set_light(set, probe, o, std::move(light), control);
  else
    set_edge(set, probe, o, std::move(light));
  set.hierarchy.reset();
  probes::write_probe_file(set, o.output);
  result.probe = static_cast<int>(probe);
  result.face_size = cube.size;
  return result;
}

json::Value to_json(const ProbeImportResult& result, const ProbeImportOptions& o) {
  json::Value object = {{"output", o.output},
                        {"probe", o.sphl},
                        {"group", o.group},
                        {"part", name_of(o.part)},
                        {"degree", result.set.degree},
                        {"face_size", result.face_size},
                        {"probes", result.set.probes.size()}};
  if (!o.viz_from.empty()) object.update({{"viz_from", o.viz_from}, {"transfer", transfer_of(result, o)}});
  return object;
}

std::string to_text(const ProbeImportResult& result, const ProbeImportOptions& o) {
  if (!o.viz_from.empty())
    return fmt::format("{}: \"{}\" gets P = {:.4g} of \"{}\", from {}x{}x6 texels, degree {}", o.output,
                       o.sphl, transfer_of(result, o), o.viz_from, result.face_size, result.face_size,
                       result.set.degree);
  const auto& probes = result.set.probes;
  const auto lit = std::ranges::count_if(probes, [](const probes::Probe& probe) {
    return std::ranges::any_of(probe.self.values, [](const vec3& v) { return v != vec3(0); });
  });
  return fmt::format("{}: {} light of \"{}\" from {}x{}x6 texels, degree {}; {} of {} probes have light",
                     o.output, name_of(o.part), o.sphl, result.face_size, result.face_size, result.set.degree,
                     lit, probes.size());
}

void add_probe_import_command(Command group, Context& context) {
  auto [command, o] = add_command(
      group, context, "import",
      "Take the light of a probe from another renderer's picture of the sphere around it", run_probe_import);
  command
      .option("IMAGE", o.images,
              "Linear radiance [W/(sr m2)] at the SPHL's place: .exr .hdr; one picture, or the six faces of "
              "`ssphh export --projection cube`, +X -X +Y -Y +Z -Z")
      .required();
  command.choice("--layout", o.layout, "Of one picture; `ssphh cubemap convert --help` tells of each");
  command.option("--emitted", o.emitted,
                 "As IMAGE, lamps and sky alone (--max-depth 0): taken off pictures that show them, too");
  command.option("--sphl", o.sphl, "Probe that the picture is of, by name").required();
  add_probe_file(command, "--into", o.into, "Probe file whose set gets the light");
  add_scene_options(command, o.scene, true, "--scene");
  command["--scene"].required(false);
  command.option("--group", o.group, "Light group; one that the set lacks is added");
  command.choice(
      "--part", o.part,
      "What the picture shows: reflected (surfaces alone, lamps and sky not seen: what lookups add to direct "
      "light) or emitted (lamps and sky alone)");
  command.option(
      "--viz-from", o.viz_from,
      "The pictures show the sphere of this SPHL as the only light (`ssphh export --viz-from`): they "
      "become the edge from it, as VIZ finds it");
  command.choice("--viz-source", o.viz_source, "How bright that sphere was, as exported");
  command.option("--degree", o.degree, "Highest band of a new set").range(0, sh::max_degree);
  add_probe_output(command, "-o,--output", o.output, "Probe file to write; may be that of --into").required();
  command.footer("A set for a whole scene: --scene for the first picture, --into for the others.");
}

}  // namespace ssphh::app
