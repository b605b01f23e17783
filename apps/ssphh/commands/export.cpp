#include <memory>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/scene_io/gltf_export.h>

#include "commands/command.h"
#include "options/picture_options.h"

namespace ssphh::app {
namespace {

struct ExportOptions {
  PictureOptions picture;
  std::string to, output;
};

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

void run(const ExportOptions& o, const Context& context) {
  const scene::Scene scene = load_scene(o.picture.scene);
  const scene_io::ExportReport report = write(o, scene);
  json::Value files = json::Value::array();
  for (const auto& file : report.files) files.push_back(file.string());
  std::string text =
      fmt::format("{}: {} file{}, {} triangles", report.files.front().string(), report.files.size(),
                  report.files.size() == 1 ? "" : "s", scene::triangle_count(scene));
  if (!report.command.empty()) text += "\nrender with: " + report.command;
  for (const std::string& line : report.differences) text += "\ndiffers: " + line;
  context.result({{"to", o.to},
                  {"files", files},
                  {"command", report.command},
                  {"differences", report.differences},
                  {"triangles", scene::triangle_count(scene)},
                  {"hash", scene::scene_hash(scene).hex()}},
                 text);
}

}  // namespace

void add_export_command(Command app, Context& context) {
  auto options = std::make_shared<ExportOptions>();
  Command command = add_command(app, context, "export", "Write a scene for another renderer",
                                [&context, options] { run(*options, context); });
  add_picture_options(command, options->picture);
  std::vector<std::string> names;
  std::string description = "Which:";
  for (const scene_io::RendererFormat& format : scene_io::renderer_formats()) {
    names.emplace_back(format.name);
    description += fmt::format(" {} ({});", format.name, format.description);
  }
  names.emplace_back("gltf");
  command
      .option(
          "--to", options->to,
          description + " gltf (one GLB file with all that a scene holds, docs/gltf.md; loads back the same)")
      .required()
      .one_of(names);
  command.option("-o,--output", options->output, "Folder to write into; for gltf also FILE.glb").required();
}

}  // namespace ssphh::app
