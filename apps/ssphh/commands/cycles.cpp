#include "commands/cycles.h"

#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/image/io.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/scene_io/renderer_export.h>

#include "commands/child_process.h"

namespace ssphh::app {
namespace {

image::CubeMap read_faces(const std::filesystem::path& folder, const char* part, int size) {
  std::vector<image::Image> pictures;
  for (int face = 0; face < 6; ++face) {
    const std::filesystem::path file = folder / fmt::format("{}{:04}.exr", part, face);
    if (!std::filesystem::exists(file))
      throw Error("blender", fmt::format("wrote no {}; blender.log beside it says why", file.string()));
    pictures.push_back(image::read_image(file));
    require(pictures.back().width == size, "blender", "its pictures are of another size than was asked for");
  }
  return image::cube_of_views(pictures);
}

}  // namespace

void require_blender() {
  if (!find_program("blender").empty()) return;
  const char* path = std::getenv("PATH");
  throw Error(
      "--renderer cycles",
      fmt::format("there is no `blender` in the folders of PATH, {}", path ? path : "(which is not set)"),
      "scripts/install-deps --with-blender installs it");
}

std::string blender_seed(std::uint64_t seed) {
  return std::to_string(seed % 0x7fffffff);
}

void run_blender(const std::filesystem::path& script, std::vector<std::string> arguments,
                 const CyclesOptions& options, const Control& control) {
  std::vector<std::string> command = {"blender",  "--background",  "--factory-startup",
                                      "--python", script.string(), "--"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  if (options.threads > 0) command.insert(command.end(), {"--threads", std::to_string(options.threads)});
  run_program(command, options.work / "blender.log", options.limit, control);
}

CyclesSource::CyclesSource(const scene::Scene& scene, float time, const rays::RadianceSource& ours,
                           const CyclesOptions& options)
    : scene_(scene), time_(time), ours_(ours), options_(options) {
  require_blender();
  options_.work = std::filesystem::absolute(options_.work);  // Blender takes what is relative from $PWD
  std::filesystem::create_directories(options_.work);
  std::filesystem::remove(options_.work / "blender.log");
}

scene::Scene CyclesSource::with_group_alone(std::size_t group) const {
  scene::LightingState state = scene::lighting_at(scene_, time_);
  for (std::size_t g = 0; g < state.group_scales.size(); ++g)
    if (g != group) state.group_scales[g] = vec3(0);
  return scene::with_lighting(scene_, state);
}

rays::GroupRadiance CyclesSource::render(const scene::Scene& lit, const rays::CubeRequest& request,
                                         const Control& control) const {
  scene_io::ExportSettings settings;
  settings.time = time_;
  settings.cube_at = request.position;
  settings.width = settings.height = request.face_size;
  settings.max_depth = request.path.max_depth;
  settings.spp = request.path.spp * request.path.passes;
  std::filesystem::remove_all(options_.work / "scene");
  const scene_io::ExportReport report = scene_io::export_cycles(lit, settings, options_.work / "scene");
  const std::filesystem::path pictures = options_.work / "scene/cube";
  run_blender(report.files.front(),
              {"--cube", (options_.work / "scene/cube.json").string(), "--output", pictures.string(),
               "--seed", blender_seed(request.path.seed)},
              options_, control);
  return {read_faces(pictures, "emitted", request.face_size),
          settings.max_depth > 0 ? read_faces(pictures, "reflected", request.face_size)
                                 : image::CubeMap(request.face_size)};
}

std::vector<rays::GroupRadiance> CyclesSource::incident_radiance(const rays::CubeRequest& request,
                                                                 const Control& control) const {
  std::vector<rays::GroupRadiance> groups;
  for (std::size_t g = 0; g < light_groups().size(); ++g)
    groups.push_back(render(with_group_alone(g), request, control));
  return groups;
}

std::vector<image::CubeMap> CyclesSource::ghost_radiance(const rays::CubeRequest& request,
                                                         std::span<const rays::GhostSphere> ghosts,
                                                         const GhostSink& sink,
                                                         const Control& control) const {
  if (sink) throw Error("--renderer cycles", "tells of no single paths", "leave out --viz-transfer");
  if (request.paths != rays::PathSet::all)
    throw Error("--renderer cycles", "cannot leave out paths", "leave out --viz-paths");
  std::vector<image::CubeMap> cubes;
  for (const rays::GhostSphere& ghost : ghosts) {
    const scene::Scene lit = scene::lit_by_sphere(scene_, time_, ghost.center, ghost.radius, 1);
    rays::GroupRadiance seen = render(lit, request, control);
    for (std::size_t f = 0; f < 6; ++f) {
      std::vector<float>& sum = seen.emitted.faces[f].pixels;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += seen.reflected.faces[f].pixels[i];
    }
    cubes.push_back(std::move(seen.emitted));
  }
  return cubes;
}

void CyclesCrew::run(const probes::ProbeSet& set, const bake::BakeParams& params,
                     std::span<const bake::ProbeStage> stages,
                     const std::function<void(bake::ProbeStageResult)>& done, const Control& control) {
  ProgressStage progress(control, "probes", stages.size(), "probes");
  for (const bake::ProbeStage& stage : stages) {
    control.check();
    done(bake::bake_stage(source_, set, params.viz_params, stage, control));
    progress.advance(1);
  }
}

}  // namespace ssphh::app
