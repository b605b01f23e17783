#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include <ssphh/farm/farm_render.h>
#include <ssphh/image/io.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/trace/path_tracer.h>

#include "commands/child_process.h"
#include "commands/command.h"
#include "options/farm_options.h"
#include "options/picture_options.h"

namespace ssphh::app {
namespace {

using image::Image;

struct TruthOptions {
  PictureOptions picture;
  FarmChoice farm;
  std::string renderer = "path", projection = "camera", output, work;
  int time_limit = 3600;
  bool halves = false;
};

/// Two pictures of the same scene with independent random numbers, half of the samples each.
struct Halves {
  Image first, second;
  std::vector<std::string> differences;
};

Halves render_path(const TruthOptions& o, const scene::Scene& scene, const FarmSession* session,
                   const Context& context) {
  std::optional<trace::PathTracer> tracer;
  if (!session) tracer.emplace(scene, o.picture.scene.time);
  const auto half = [&](std::uint64_t seed) {
    trace::RenderParams params;
    params.width = o.picture.width, params.height = o.picture.height;
    params.camera = scene::camera_pose(scene, o.picture.camera, o.picture.scene.time);
    if (o.projection == "equirect") {
      params.projection = trace::Projection::equirect;
    } else if (params.camera.camera.orthographic) {
      params.projection = trace::Projection::orthographic;
    }
    params.path = {o.picture.max_depth, 1, o.picture.spp / 2, seed};
    trace::RenderState state;
    if (session) {
      farm::FarmReport report;
      state = farm::render(session->options(), scene, o.picture.scene.time, params, std::nullopt, {"color"},
                           report, context.control);
    } else {
      tracer->render(params, state, context.control);
    }
    return trace::resolve(state.color, state.passes_done);
  };
  return {half(2 * context.seed), half(2 * context.seed + 1), {}};
}

Halves render_cycles(const TruthOptions& o, const scene::Scene& scene, const Context& context) {
  if (find_program("blender").empty()) {
    const char* path = std::getenv("PATH");
    throw Error(
        "--renderer cycles",
        fmt::format("there is no `blender` in the folders of PATH, {}", path ? path : "(which is not set)"),
        "scripts/install-deps --with-blender installs it");
  }
  const std::filesystem::path work = o.work.empty() ? o.output + ".cycles" : o.work;
  const scene_io::ExportReport report =
      scene_io::export_cycles(scene, export_settings(o.picture, scene), work);
  const std::filesystem::path log = work / "blender.log";
  std::filesystem::remove(log);
  const auto half = [&](std::uint64_t seed, const std::string& name) {
    const std::filesystem::path picture = work / name;
    std::filesystem::remove(picture);
    // Cycles' seed is a signed 32-bit number.
    std::vector<std::string> command = {"blender",
                                        "--background",
                                        "--factory-startup",
                                        "--python",
                                        report.files.front().string(),
                                        "--",
                                        "--output",
                                        picture.string(),
                                        "--seed",
                                        std::to_string(seed % 0x7fffffff),
                                        "--spp",
                                        std::to_string(o.picture.spp / 2),
                                        "--projection",
                                        o.projection};
    if (context.threads > 0) command.insert(command.end(), {"--threads", std::to_string(context.threads)});
    run_program(command, log, std::chrono::seconds(o.time_limit), context.control);
    if (!std::filesystem::exists(picture)) {
      throw Error("blender", fmt::format("wrote no picture; {} says why", log.string()));
    }
    return image::read_image(picture);
  };
  ProgressStage stage(context.control, "Cycles", 2, "halves");
  Halves halves{half(2 * context.seed, "a.exr"), {}, report.differences};
  stage.advance(1);
  halves.second = half(2 * context.seed + 1, "b.exr");
  stage.advance(1);
  return halves;
}

Image mean_of(const Image& a, const Image& b) {
  Image mean = a;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
  return mean;
}

struct MeanRadiance {
  glm::dvec3 mean{0}, standard_error{0};
};

// Over the picture; pixels are independent, so the errors' squares add up.
MeanRadiance mean_radiance(const Halves& halves) {
  MeanRadiance result;
  glm::dvec3 squared(0);
  for (int y = 0; y < halves.first.height; ++y) {
    for (int x = 0; x < halves.first.width; ++x) {
      const glm::dvec3 a(halves.first.rgb(x, y)), b(halves.second.rgb(x, y));
      result.mean += 0.5 * (a + b);
      squared += 0.25 * (a - b) * (a - b);
    }
  }
  const double pixels = static_cast<double>(halves.first.width) * halves.first.height;
  result.mean /= pixels;
  result.standard_error = glm::sqrt(squared) / pixels;
  return result;
}

json::Value array(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

void run(const TruthOptions& o, const Context& context) {
  if (o.farm.any() && o.renderer != "path")
    throw Error("--renderer " + o.renderer, "is not for a farm", "leave out --broker and --local");
  std::optional<FarmSession> session;  // first: its processes start while this one reads the scene
  if (o.farm.any()) session.emplace(o.farm);
  const scene::Scene scene = load_scene(o.picture.scene);
  const auto start = std::chrono::steady_clock::now();
  const Halves halves = o.renderer == "cycles"
                            ? render_cycles(o, scene, context)
                            : render_path(o, scene, session ? &*session : nullptr, context);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Image picture = mean_of(halves.first, halves.second);
  image::write_image(o.output, picture);
  if (o.halves) {
    const std::filesystem::path output = o.output;
    const std::string stem = (output.parent_path() / output.stem()).string();
    image::write_image(stem + ".a" + output.extension().string(), halves.first);
    image::write_image(stem + ".b" + output.extension().string(), halves.second);
  }
  const MeanRadiance mean = mean_radiance(halves);
  // Half the halves' difference is as large as the error of their mean.
  const metrics::ImageError noise = metrics::compare(picture, halves.first);
  std::string text = fmt::format(
      "{}: {}×{}, {} samples per pixel, depth {}, by {} in {:.2f} s\nmean radiance {:.5g} {:.5g} {:.5g} "
      "(standard error {:.1e} {:.1e} {:.1e})\n"
      "noise: RMSE {:.4g}, relMSE {:.4g}",
      o.output, picture.width, picture.height, o.picture.spp / 2 * 2, o.picture.max_depth, o.renderer,
      seconds, mean.mean.x, mean.mean.y, mean.mean.z, mean.standard_error.x, mean.standard_error.y,
      mean.standard_error.z, noise.rmse, noise.relmse);
  for (const std::string& line : halves.differences) text += "\ndiffers: " + line;
  context.result({{"output", o.output},
                  {"renderer", o.renderer},
                  {"projection", o.projection},
                  {"width", picture.width},
                  {"height", picture.height},
                  {"spp", o.picture.spp / 2 * 2},
                  {"max_depth", o.picture.max_depth},
                  {"seconds", seconds},
                  {"mean", array(mean.mean)},
                  {"standard_error", array(mean.standard_error)},
                  {"noise", {{"mse", noise.mse}, {"rmse", noise.rmse}, {"relmse", noise.relmse}}},
                  {"differences", halves.differences}},
                 text);
}

}  // namespace

void add_truth_command(Command app, Context& context) {
  auto options = std::make_shared<TruthOptions>();
  TruthOptions& o = *options;
  Command command = add_command(app, context, "truth", "Render a reference picture and tell its own noise",
                                [&context, options] { run(*options, context); });
  add_picture_options(command, o.picture);
  add_farm_options(command, o.farm);
  command.option("--renderer", o.renderer, "path: our path tracer; cycles: Blender, which must be installed")
      .one_of({"path", "cycles"});
  command
      .option("--projection", o.projection,
              "camera; or equirect, the whole sphere around it (`ssphh cubemap convert` makes it a cube)")
      .one_of({"camera", "equirect"});
  command.option("-o,--output", o.output, "Picture: .exr or .hdr (linear radiance)").required();
  command.flag("--halves", o.halves, "Also write the two independent halves, OUT.a.exr and OUT.b.exr");
  command.option("--work", o.work, "Folder for the other renderer's files and log; default: OUT.cycles");
  command.option("--time-limit", o.time_limit, "Seconds that each half may take").range(1, 1000000);
  command.footer(
      "Half of the samples make each of two independent pictures. The result is their mean; its noise is "
      "estimated\n"
      "from their difference: relMSE as `ssphh compare` defines it, with the result as reference.");
}

}  // namespace ssphh::app
