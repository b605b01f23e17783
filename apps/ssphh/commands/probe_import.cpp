#include "commands/probe_import.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/query.h>
#include <ssphh/sh/project.h>

#include "commands/command.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

image::CubeMap read_cube(const ProbeImportOptions& o, const Control& control) {
  const image::Image picture = image::read_image(o.input);
  image::CubeMap cube;
  try {
    cube = image::to_cube(picture, o.layout, 0, control);
  } catch (const Error& e) {
    throw Error(o.input, e.problem(), e.hint());
  }
  for (std::size_t f = 0; f < cube.faces.size(); ++f) {
    const image::Image& face = cube.faces[f];
    if (face.channels < 3) throw Error(o.input, "is grey", "light needs three channels");
    for (int y = 0; y < face.height; ++y) {
      for (int x = 0; x < face.width; ++x) {
        const vec3 color = face.rgb(x, y);
        if (is_finite(color) && glm::all(glm::greaterThanEqual(color, vec3(0)))) continue;
        throw Error(o.input,
                    fmt::format("has radiance {:g}, {:g}, {:g} at texel ({}, {}) of face {}", color.x,
                                color.y, color.z, x, y, f),
                    "light is finite and not negative; render it without filters that ring");
      }
    }
  }
  return cube;
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

std::size_t probe_named(const probes::ProbeSet& set, const std::string& name) {
  const auto found = std::ranges::find(set.probes, name, &probes::Probe::name);
  if (found != set.probes.end()) return static_cast<std::size_t>(found - set.probes.begin());
  std::vector<std::string> names;
  for (const probes::Probe& probe : set.probes) names.push_back(probe.name);
  if (names.size() > 20) names.resize(20);
  throw Error("--sphl", fmt::format("there is no probe \"{}\"", name),
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

}  // namespace

ProbeImportResult run_probe_import(const ProbeImportOptions& o, const Control& control) {
  ProbeImportResult result{set_to_fill(o)};
  probes::ProbeSet& set = result.set;
  const std::size_t probe = probe_named(set, o.sphl);
  const image::CubeMap cube = read_cube(o, control);
  const std::size_t group = group_named(set, o.group);
  sh::CubeFaces faces;
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = cube.faces[f].pixels;
  const sh::RadianceSh light = sh::project_cube(set.degree, cube.size, faces, cube.faces[0].channels);
  probes::GroupLight& target = set.probes[probe].groups[group];
  (o.part == LightPart::reflected ? target.reflected : target.emitted) = light;
  if (set.surface)
    log_warning("{}: the light of its surface records is left out: it is another's than the picture's",
                o.output);
  set.surface.reset(), set.baseline.reset(), set.hierarchy.reset();
  probes::merge_groups(set);
  probes::write_probe_file(set, o.output);
  result.probe = static_cast<int>(probe);
  result.face_size = cube.size;
  return result;
}

json::Value to_json(const ProbeImportResult& result, const ProbeImportOptions& o) {
  return {{"output", o.output},
          {"probe", o.sphl},
          {"group", o.group},
          {"part", name_of(o.part)},
          {"degree", result.set.degree},
          {"face_size", result.face_size},
          {"probes", result.set.probes.size()}};
}

std::string to_text(const ProbeImportResult& result, const ProbeImportOptions& o) {
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
  command.option("IMAGE", o.input, "Linear radiance [W/(sr m2)] at the SPHL's place: .exr .hdr").required();
  command.choice("--layout", o.layout, "Of the picture; `ssphh cubemap convert --help` tells of each")
      .required();
  command.option("--sphl", o.sphl, "Probe that the picture is of, by name").required();
  add_probe_file(command, "--into", o.into, "Probe file whose set gets the light");
  add_scene_options(command, o.scene, true, "--scene");
  command["--scene"].required(false);
  command.option("--group", o.group, "Light group; one that the set lacks is added");
  command.choice(
      "--part", o.part,
      "What the picture shows: reflected (surfaces alone, lamps and sky not seen: what lookups add to direct "
      "light) or emitted (lamps and sky alone)");
  command.option("--degree", o.degree, "Highest band of a new set").range(0, sh::max_degree);
  add_probe_file(command, "-o,--output", o.output, "Probe file to write; may be that of --into").required();
  command.footer("A set for a whole scene: --scene for the first picture, --into for the others.");
}

}  // namespace ssphh::app
