#include "commands/truth.h"

#include <chrono>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include <ssphh/core/stopwatch.h>
#include <ssphh/farm/farm_render.h>
#include <ssphh/image/io.h>
#include <ssphh/trace/path_tracer.h>

#include "commands/command.h"
#include "results/json_values.h"
#include "results/pictures.h"

namespace ssphh::app {
namespace {

using image::Image;

/// Two pictures of the same scene with independent random numbers, half of the samples each.
struct Halves {
  Image first, second;
  std::vector<std::string> differences;
};

Halves render_path(const TruthOptions& o, const scene::Scene& scene,
                   const std::optional<FarmSession>& session, const Control& control) {
  trace::SharedGeometry geometry;
  if (!session) geometry = std::make_shared<const trace::SceneGeometry>(scene);
  std::optional<trace::PathTracer> tracer;
  if (!session) tracer.emplace(geometry, scene, o.picture.scene.time);
  const scene::CameraPose camera = camera_of(scene, o.picture.camera, o.picture.scene.time, geometry);
  const auto half = [&](std::uint64_t seed) {
    trace::RenderParams params;
    params.width = o.picture.width, params.height = o.picture.height;
    params.camera = camera;
    params.projection = projection_of(o.projection, params.camera.camera);
    params.path = {o.picture.max_depth, 1, o.picture.spp / 2, seed};
    trace::RenderState state;
    if (session) {
      farm::FarmReport report;
      state = farm::render(session->options(), scene, o.picture.scene.time, params, std::nullopt,
                           {trace::RenderLayer::color}, report, control);
    } else {
      tracer->render(params, state, control);
    }
    return trace::resolve(state.color, state.passes_done);
  };
  return {half(2 * o.seed), half(2 * o.seed + 1), {}};
}

Halves render_cycles(const TruthOptions& o, const scene::Scene& scene, const Control& control) {
  require_blender();
  // Blender takes what is relative from $PWD, where a script that started us elsewhere may have left another
  // folder.
  const std::filesystem::path work =
      std::filesystem::absolute(o.work.empty() ? o.output + ".cycles" : o.work);
  const scene_io::ExportReport report =
      scene_io::export_cycles(scene, export_settings(o.picture, scene), work);
  const std::filesystem::path log = work / "blender.log";
  std::filesystem::remove(log);
  const auto half = [&](std::uint64_t seed, const std::string& name) {
    const std::filesystem::path picture = work / name;
    std::filesystem::remove(picture);
    run_blender(report.files.front(),
                {"--output", picture.string(), "--seed", blender_seed(seed), "--spp",
                 std::to_string(o.picture.spp / 2), "--projection", std::string(name_of(o.projection))},
                {work, o.threads, std::chrono::seconds(o.time_limit)}, control);
    if (!std::filesystem::exists(picture)) {
      throw Error("blender", fmt::format("wrote no picture; {} says why", log.string()));
    }
    return image::read_image(picture);
  };
  ProgressStage stage(control, "Cycles", 2, "halves");
  Halves halves{half(2 * o.seed, "a.exr"), {}, report.differences};
  stage.advance(1);
  halves.second = half(2 * o.seed + 1, "b.exr");
  stage.advance(1);
  return halves;
}

Image mean_of(const Image& a, const Image& b) {
  Image mean = a;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
  return mean;
}

// Over the picture; pixels are independent, so the errors' squares add up.
void find_mean(TruthResult& result) {
  glm::dvec3 squared(0);
  for (int y = 0; y < result.first.height; ++y) {
    for (int x = 0; x < result.first.width; ++x) {
      const glm::dvec3 a(result.first.rgb(x, y)), b(result.second.rgb(x, y));
      result.mean += 0.5 * (a + b);
      squared += 0.25 * (a - b) * (a - b);
    }
  }
  const double pixels = static_cast<double>(result.first.width) * result.first.height;
  result.mean /= pixels;
  result.standard_error = glm::sqrt(squared) / pixels;
}

}  // namespace

TruthResult run_truth(const TruthOptions& o, const Control& control) {
  if (o.farm.any() && o.renderer != Renderer::path)
    throw Error(fmt::format("--renderer {}", name_of(o.renderer)), "is not for a farm",
                "leave out --broker and --local");
  const std::optional<FarmSession> session = farm_session(o.farm);
  const scene::Scene scene = load_lit_scene(o.picture.scene);
  const Stopwatch watch;
  Halves halves = o.renderer == Renderer::cycles ? render_cycles(o, scene, control)
                                                 : render_path(o, scene, session, control);
  TruthResult result;
  result.seconds = watch.seconds();
  result.first = std::move(halves.first), result.second = std::move(halves.second);
  result.differences = std::move(halves.differences);
  result.picture = mean_of(result.first, result.second);
  if (is_display_format(o.output)) result.exposure = SharedExposure(o.exposure).of(result.picture);
  const image::ToneMap map{.exposure = result.exposure.value_or(0)};
  write_picture(o.output, result.picture, map);
  if (o.halves) {
    const std::string extension = std::filesystem::path(o.output).extension().string();
    write_picture(beside(o.output, "a" + extension), result.first, map);
    write_picture(beside(o.output, "b" + extension), result.second, map);
  }
  find_mean(result);
  // Half the halves' difference is as large as the error of their mean.
  result.noise = metrics::compare(result.picture, result.first);
  return result;
}

json::Value to_json(const TruthResult& r, const TruthOptions& o) {
  json::Value object = {{"output", o.output},
                        {"renderer", name_of(o.renderer)},
                        {"projection", name_of(o.projection)},
                        {"width", r.picture.width},
                        {"height", r.picture.height},
                        {"spp", o.picture.spp / 2 * 2},
                        {"max_depth", o.picture.max_depth},
                        {"seconds", r.seconds},
                        {"mean", to_json(r.mean)},
                        {"standard_error", to_json(r.standard_error)},
                        {"noise", {{"mse", r.noise.mse}, {"rmse", r.noise.rmse}, {"relmse", r.noise.relmse}}},
                        {"differences", r.differences}};
  if (r.exposure) object["exposure"] = *r.exposure;
  return object;
}

std::string to_text(const TruthResult& r, const TruthOptions& o) {
  const glm::dvec3 &mean = r.mean, &error = r.standard_error;
  std::string text = fmt::format(
      "{}: {}×{}, {} samples per pixel, depth {}, by {} in {:.2f} s\nmean radiance {:.5g} {:.5g} {:.5g} "
      "(standard error {:.1e} {:.1e} {:.1e})\n"
      "noise: RMSE {:.4g}, relMSE {:.4g}",
      o.output, r.picture.width, r.picture.height, o.picture.spp / 2 * 2, o.picture.max_depth,
      name_of(o.renderer), r.seconds, mean.x, mean.y, mean.z, error.x, error.y, error.z, r.noise.rmse,
      r.noise.relmse);
  if (r.exposure) text += "\n" + exposure_text(*r.exposure);
  for (const std::string& line : r.differences) text += "\ndiffers: " + line;
  return text;
}

void add_truth_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "truth", "Render a reference picture and tell its own noise", run_truth);
  add_picture_options(command, o.picture);
  add_farm_options(command, o.farm);
  command.choice("--renderer", o.renderer, "path: our path tracer; cycles: Blender, which must be installed");
  command.choice("--projection", o.projection,
                 "camera; or equirect, the whole sphere around it (`ssphh cubemap convert` makes it a cube)",
                 {"camera", "equirect"});
  command
      .option("-o,--output", o.output, "Picture: .exr or .hdr (linear radiance), .png or .jpg (tone mapped)")
      .required();
  add_exposure_option(command, o.exposure, "Of a .png or .jpg, in stops; auto: what suits the picture");
  command.flag("--halves", o.halves, "Also write the two independent halves, OUT.a.exr and OUT.b.exr");
  command.option("--work", o.work, "Folder for the other renderer's files and log; default: OUT.cycles");
  command.option("--time-limit", o.time_limit, "Seconds that each half may take").range(1, 1000000);
  command.footer(
      "Half of the samples make each of two independent pictures. The result is their mean; its noise is "
      "estimated\n"
      "from their difference: relMSE as `ssphh compare` defines it, with the result as reference.");
}

}  // namespace ssphh::app
