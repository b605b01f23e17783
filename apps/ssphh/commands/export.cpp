#include "commands/export.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/scene_io/gltf_export.h>

#include "commands/command.h"

namespace ssphh::app {
namespace {

// One file holds the whole scene, so its name may be given instead of a folder's.
scene_io::ExportReport write_gltf(const scene::Scene& scene, const std::filesystem::path& output) {
  const bool is_file = output.extension() == ".glb";
  if (!is_file) std::filesystem::create_directories(output);
  scene_io::ExportReport report;
  report.files.push_back(is_file ? output : output / "scene.glb");
  scene_io::write_glb(report.files.front(), scene);
  return report;
}

void check_options(const ExportOptions& o) {
  if (std::ranges::count(export_formats(), o.to) == 0)
    throw Error("--to " + o.to, "is no format that there is");
  const bool cube = o.projection == PictureProjection::cube;
  if (!o.at.empty() && !cube) throw Error("--at", "is the place of a cube", "add --projection cube");
  if (o.to == "gltf" && (cube || !o.viz_from.empty()))
    throw Error("--to gltf", "holds the scene, no picture of it",
                "leave out --projection and --viz-from, or choose a renderer");
}

scene_io::ExportSettings settings_of(const ExportOptions& o, const scene::Scene& scene) {
  scene_io::ExportSettings settings = export_settings(o.picture, scene);
  if (o.projection != PictureProjection::cube) return settings;
  settings.cube_at = o.at.empty() ? vec3(settings.camera.world[3]) : place_of(scene, o.at, settings.time);
  settings.width = settings.height = o.face_size;
  settings.shows_emitters = !o.viz_from.empty() || settings.max_depth == 0;
  return settings;
}

// Lit by the sphere of that SPHL alone.
scene::Scene viz_scene(const ExportOptions& o, const scene::Scene& scene,
                       const scene_io::ExportSettings& settings) {
  const std::vector<scene::ProbePlace> places = scene::sphl_places(scene, settings.time);
  const auto from = std::ranges::find(places, o.viz_from, &scene::ProbePlace::name);
  if (from == places.end()) {
    std::vector<std::string> names;
    for (const scene::ProbePlace& place : places) names.push_back(place.name);
    throw Error("--viz-from " + o.viz_from, "is no SPHL of the scene",
                names.empty() ? "the scene has none" : fmt::format("its SPHLs: {}", fmt::join(names, ", ")));
  }
  if (settings.cube_at && glm::distance(*settings.cube_at, from->position) <= from->radius)
    throw Error("--at " + o.at,
                fmt::format("lies within the sphere of \"{}\", of radius {:g} m", from->name, from->radius),
                "VIZ looks at a sphere from outside");
  return scene::lit_by_sphere(scene, settings.time, from->position, from->radius,
                              probes::emitter_radiance(o.viz_source, from->radius));
}

scene_io::ExportReport write(const ExportOptions& o, const scene::Scene& scene) {
  for (const scene_io::RendererFormat& format : scene_io::renderer_formats()) {
    if (format.name != o.to) continue;
    const scene_io::ExportSettings settings = settings_of(o, scene);
    if (o.viz_from.empty()) return format.write(scene, settings, o.output);
    return format.write(viz_scene(o, scene, settings), settings, o.output);
  }
  return write_gltf(scene, o.output);
}

}  // namespace

std::vector<std::string> export_formats() {
  std::vector<std::string> names;
  for (const scene_io::RendererFormat& format : scene_io::renderer_formats()) names.emplace_back(format.name);
  names.emplace_back("gltf");
  return names;
}

ExportResult run_export(const ExportOptions& o, const Control&) {
  check_options(o);
  SceneOptions options = o.picture.scene;
  options.keep_dark_light = o.to == "gltf";  // a copy as glTF is no picture, and stays as it was
  const scene::Scene scene = o.to == "gltf" ? load_scene(options) : load_lit_scene(options);
  return {write(o, scene), scene::triangle_count(scene), scene::scene_hash(scene)};
}

json::Value to_json(const ExportResult& result, const ExportOptions& o) {
  json::Value files = json::Value::array();
  for (const auto& file : result.report.files) files.push_back(file.string());
  return {{"to", o.to},
          {"files", files},
          {"command", result.report.command},
          {"differences", result.report.differences},
          {"triangles", result.triangles},
          {"hash", result.hash.hex()}};
}

std::string to_text(const ExportResult& result, const ExportOptions&) {
  const scene_io::ExportReport& report = result.report;
  std::string text = fmt::format("{}: {}, {}", report.files.front().string(),
                                 counted(report.files.size(), "file"), counted(result.triangles, "triangle"));
  if (!report.command.empty()) text += "\nrender with: " + report.command;
  for (const std::string& line : report.differences) text += "\ndiffers: " + line;
  return text;
}

void add_export_command(Command app, Context& context) {
  auto [command, o] = add_command(app, context, "export", "Write a scene for another renderer", run_export);
  add_picture_options(command, o.picture);
  std::string description = "Which:";
  for (const scene_io::RendererFormat& format : scene_io::renderer_formats())
    description += fmt::format(" {} ({});", format.name, format.description);
  command
      .option(
          "--to", o.to,
          description + " gltf (one GLB file with all that a scene holds, docs/gltf.md; loads back the same)")
      .required()
      .one_of(export_formats());
  command.option("-o,--output", o.output, "Folder to write into; for gltf also FILE.glb").required();

  const Command probes = command.under("Pictures for a probe");
  probes.choice(
      "--projection", o.projection,
      "camera; or cube: six pictures of 90 degrees around a place, without lamps and sky themselves, "
      "for `ssphh probe import` (docs/export.md)",
      {"camera", "cube"});
  add_at_option(probes, o.at);
  probes.option("--face", o.face_size, "Pixels along a face of the cube").range(1, 4096);
  probes.option("--viz-from", o.viz_from,
                "Light the scene by the sphere of this SPHL alone, as VIZ does, and show the sphere too");
  probes.choice("--viz-source", o.viz_source,
                "What that sphere sends out: total intensity 1 (the paper's), or radiance 1");
}

}  // namespace ssphh::app
