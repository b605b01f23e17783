#include "commands/export.h"

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
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

scene_io::ExportReport write(const ExportOptions& o, const scene::Scene& scene) {
  for (const scene_io::RendererFormat& format : scene_io::renderer_formats()) {
    if (format.name == o.to) return format.write(scene, export_settings(o.picture, scene), o.output);
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
  if (std::ranges::count(export_formats(), o.to) == 0)
    throw Error("--to " + o.to, "is no format that there is");
  const scene::Scene scene =  // a copy as glTF is no picture, and stays as it was
      o.to == "gltf" ? load_scene(o.picture.scene) : load_lit_scene(o.picture.scene);
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
}

}  // namespace ssphh::app
