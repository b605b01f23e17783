// Commands that make pictures, and those around them, as the functions that they are: called with structs,
// without a process or a command line, and held against what the library says of the same.

#include <atomic>
#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/bake/bake.h>
#include <ssphh/core/file.h>
#include <ssphh/image/exposure.h>
#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/report/report.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/window.h>
#include <ssphh/trace/path_tracer.h>

#include "commands/cubemap.h"
#include "commands/export.h"
#include "commands/render.h"
#include "commands/report.h"
#include "commands/sh.h"
#include "commands/truth.h"
#include "commands/turntable.h"
#include "error_message.h"
#include "places.h"
#include "results/moving_camera.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using test::message_of;
using testing::HasSubstr;

/// builtin:two-rooms with its door half open.
class RoomsInPictures : public testing::Test {
 protected:
  const test::TempDir dir_;
  const scene::Scene scene_ = scene::make_builtin("two-rooms");
  const trace::PathTracer tracer_{scene_, 0.5f};
};

TEST_F(RoomsInPictures, RenderHandsBackTheLibrarysPicture) {
  RenderOptions options;
  options.scene.source = "builtin:two-rooms";
  options.scene.time = 0.5f;
  options.output = dir_ / "o.exr";
  options.aovs = {trace::RenderLayer::albedo};
  options.width = 8, options.height = 6;
  options.passes = 2, options.spp = 1, options.seed = 7;
  trace::RenderParams params;
  params.width = 8, params.height = 6;
  params.camera = scene::camera_pose(scene_, "", 0.5f);
  params.path = {.max_depth = rays::usual_max_depth, .passes = 2, .spp = 1, .seed = 7};
  const auto picture = [](const trace::RenderState& s) { return trace::resolve(s.color, s.passes_done); };

  trace::RenderState state;
  tracer_.render(params, state);
  const RenderResult traced = run_render(options);
  EXPECT_EQ(traced.picture.pixels, picture(state).pixels);
  EXPECT_EQ(image::read_image(options.output).pixels, traced.picture.pixels);
  EXPECT_EQ(image::read_image(dir_ / "o.albedo.exr").pixels, trace::resolve(state.albedo, 2).pixels);
  EXPECT_EQ(traced.passes, 2);
  EXPECT_EQ(traced.paths, 8u * 6 * 2);
  EXPECT_EQ(traced.rays, state.rays);
  EXPECT_EQ(traced.geometry_builds, 1u);
  EXPECT_FALSE(traced.method || traced.farm || traced.gl);

  options.farm.local = 1, options.farm.tool = test::tool_path(), options.farm.cache = "none";
  const RenderResult on_farm = run_render(options);
  EXPECT_EQ(on_farm.picture.pixels, traced.picture.pixels);
  ASSERT_TRUE(on_farm.farm);
  EXPECT_EQ(on_farm.farm->units, 1u) << "a tile";
  options.farm = {};

  bake::BakeParams bake;
  bake.face_size = 2, bake.path.spp = 2;
  bake::BakeReport report;
  const probes::ProbeSet set = bake::bake(tracer_, place::init_from_scene(scene_, 1, 0.5f), bake, "", report);
  options.method = "ssphh", options.probes = dir_ / "a.sphl";
  probes::write_probe_file(set, options.probes);
  options.lookup.weights = probes::WeightMethod::distance;
  trace::RenderState looked_up;
  const auto light =
      probes::make_lookup(probes::LookupMethod::irradiance, set, tracer_,
                          probes::lookup_params({.weights = probes::WeightMethod::distance}, set));
  tracer_.render_with(*light, params, looked_up);
  const RenderResult with_probes = run_render(options);
  EXPECT_EQ(with_probes.picture.pixels, picture(looked_up).pixels);
  EXPECT_NE(with_probes.picture.pixels, traced.picture.pixels);

  options.method = "direct", options.probes = "";
  const RenderResult direct = run_render(options);
  EXPECT_EQ(direct.picture.pixels, trace::resolve(looked_up.direct, 2).pixels) << "it has no indirect light";
  EXPECT_TRUE(direct.method);
}

/// Asks for a stop once half of all is done.
class StopHalfWay final : public Progress {
 public:
  void begin(const std::string&, std::uint64_t total, const std::string&) override { total_ = total; }
  void advance(std::uint64_t count) override {
    if (2 * (done_ += count) == total_) token.request();
  }
  void end() override {}
  CancelToken token;

 private:
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_{0};
};

TEST(Commands, RenderKeepsThePassesBeforeACancelAndResumes) {
  const test::TempDir dir;
  RenderOptions options;
  options.scene.source = "builtin:two-rooms";
  options.output = dir / "o.exr";
  options.width = 8, options.height = 6;
  options.passes = 2, options.spp = 1;
  const RenderResult whole = run_render(options);
  const std::string state = options.output + ".state";
  EXPECT_FALSE(std::filesystem::exists(state));

  StopHalfWay progress;
  testing::internal::CaptureStderr();
  EXPECT_THROW(run_render(options, {&progress, &progress.token}), Cancelled);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("1 of 2 passes"));
  EXPECT_TRUE(std::filesystem::exists(state));
  options.resume = true;
  const RenderResult resumed = run_render(options);
  EXPECT_EQ(resumed.picture.pixels, whole.picture.pixels);
  EXPECT_EQ(resumed.rays, whole.rays) << "those of the first pass count too";
  EXPECT_FALSE(std::filesystem::exists(state));
}

TEST_F(RoomsInPictures, TruthIsTheMeanOfTwoHalvesWithSeedsOfTheirOwn) {
  TruthOptions options;
  options.picture.scene.source = "builtin:two-rooms";
  options.picture.scene.time = 0.5f;
  options.picture.width = 8, options.picture.height = 6;
  options.picture.max_depth = 2;
  options.picture.spp = 5;
  options.seed = 3;
  options.output = dir_ / "t.exr", options.halves = true;
  const TruthResult result = run_truth(options);
  const auto half = [&](std::uint64_t seed) {
    trace::RenderParams params;
    params.width = 8, params.height = 6;
    params.camera = scene::camera_pose(scene_, "", 0.5f);
    params.path = {.max_depth = 2, .passes = 1, .spp = 2, .seed = seed};
    trace::RenderState state;
    tracer_.render(params, state);
    return state.color;
  };
  EXPECT_EQ(result.first.pixels, half(6).pixels);
  EXPECT_EQ(result.second.pixels, half(7).pixels);
  EXPECT_EQ(image::read_image(dir_ / "t.a.exr").pixels, result.first.pixels);
  EXPECT_EQ(image::read_image(dir_ / "t.b.exr").pixels, result.second.pixels);
  EXPECT_EQ(image::read_image(options.output).pixels, result.picture.pixels);
  EXPECT_EQ(result.picture.pixels[0], 0.5f * (result.first.pixels[0] + result.second.pixels[0]));
  EXPECT_EQ(result.noise.mse, metrics::compare(result.picture, result.first).mse);
  EXPECT_GT(result.noise.mse, 0);
  EXPECT_TRUE(result.differences.empty());

  options.renderer = Renderer::cycles, options.farm.local = 1;
  EXPECT_THAT(message_of([&] { run_truth(options); }), HasSubstr("--renderer cycles: is not for a farm"));
}

TEST(Commands, TurntableDrawsWhatStandsBeforeTheCameraOnItsCircle) {
  const test::TempDir dir;
  TurntableOptions options;
  options.scene.source = "builtin:cornell";
  options.directory = dir / "turn";
  options.width = 24, options.height = 16;
  options.frames = 8, options.samples = 1;
  TurntableResult result;
  try {
    result = run_turntable(options);
  } catch (const Error& e) {
    GTEST_SKIP() << e.what();
  }
  const scene::Scene scene = scene::make_builtin("cornell");
  gl::Context gl = gl::Context::headless();
  EXPECT_EQ(result.renderer, gl.info().renderer);
  realtime::Renderer renderer(gl, scene);
  const scene::Bounds box = scene::world_bounds(scene, scene::world_matrices(scene));
  renderer.draw(orbit(box, glm::radians(40.0f), 1.5f, glm::radians(20.0f), pi / 4), still_settings({}, 1),
                {.width = 24, .height = 16});
  const auto eighth = renderer.read_back();
  renderer.draw(orbit(box, glm::radians(40.0f), 1.5f, glm::radians(20.0f), 0), still_settings({}, 1),
                {.width = 24, .height = 16});
  EXPECT_EQ(result.exposure, image::automatic_exposure(renderer.read_back())) << "of the first picture";
  image::write_image(dir / "eighth.png", image::tone_map(eighth, {.exposure = result.exposure}));
  EXPECT_EQ(read_file(options.directory + "/0001.png"), read_file(dir / "eighth.png"));
  EXPECT_NE(read_file(options.directory + "/0007.png"), read_file(dir / "eighth.png"));
  EXPECT_FALSE(std::filesystem::exists(options.directory + "/0008.png"));
}

/// An equirectangular picture of which no two pixels are alike, in a file.
image::Image sphere_picture(const std::string& file) {
  image::Image picture(16, 8, 3);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = 1 + std::sin(static_cast<float>(i));
  image::write_image(file, picture);
  return picture;
}

TEST(Commands, CubemapHandsBackTheLibrarysPicture) {
  const test::TempDir dir;
  CubemapOptions options{.input = dir / "in.exr", .output = dir / "out.exr"};
  options.to = image::Layout::strip_h;
  options.size = 3;
  const image::Image input = sphere_picture(options.input);
  const CubemapResult result = run_cubemap_convert(options);
  EXPECT_EQ(result.picture.pixels,
            image::convert_layout(input, image::Layout::equirect, image::Layout::strip_h, 3).pixels);
  EXPECT_EQ(image::read_image(options.output).pixels, result.picture.pixels);
  EXPECT_EQ(result.picture.width, 18) << "six faces";
  options.from = image::Layout::strip_h;
  EXPECT_THAT(message_of([&] { run_cubemap_convert(options); }), HasSubstr(options.input));
}

TEST(Commands, ShHandsBackTheLibrarysCoefficients) {
  const test::TempDir dir;
  const std::string file = dir / "l.json";
  sphere_picture(dir / "in.exr");
  const ShCoefficients projected = run_sh_project(
      {.image = dir / "in.exr", .layout = image::Layout::equirect, .degree = 3, .output = file});
  EXPECT_EQ(projected.degree, 3);
  EXPECT_EQ(projected.values.size(), 16u);
  sh::RadianceSh light = sh::from_convention(projected.values, sh::Convention::ssphh);
  EXPECT_EQ(json::parse(read_text_file(file), file), to_json(projected));

  const ShEvalResult basis = run_sh_eval({.degree = 2, .direction = {0, 3, 0}});
  std::vector<double> wanted(9);
  sh::eval_basis(2, glm::dvec3(0, 1, 0), wanted);
  EXPECT_EQ(basis.values, wanted) << "of any length";
  EXPECT_EQ(run_sh_irradiance({.file = file, .normal = {0, 0, 2}}).irradiance,
            sh::irradiance(light, vec3(0, 0, 1)));

  ShRotateOptions rotate;
  rotate.file = file;
  rotate.quaternion = {0, 2, 0, 0};  // half a turn about y
  const glm::dmat3 half_turn = glm::mat3_cast(glm::dquat(0, 0, 1, 0));
  const sh::RadianceSh turned = sh::Rotation(3, half_turn).apply(light);
  EXPECT_EQ(run_sh_rotate(rotate).values, std::vector<vec3>(turned.values.begin(), turned.values.end()));

  ShWindowOptions window;
  window.file = file;
  window.lanczos = 3;
  const sh::RadianceSh damped = sh::apply_window(light, sh::lanczos_window(3));
  EXPECT_EQ(run_sh_window(window).values, std::vector<vec3>(damped.values.begin(), damped.values.end()));

  ShConvertOptions convert;
  convert.file = file;
  convert.to = sh::Convention::unity;
  testing::internal::CaptureStderr();
  const ShCoefficients stored = run_sh_convert(convert);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("bands 3..3 are dropped"));
  EXPECT_EQ(stored.degree, 2);
  EXPECT_EQ(stored.values, sh::to_convention(light, sh::Convention::unity));
  EXPECT_EQ(stored.convention, sh::Convention::unity);
}

TEST(Commands, ShReconstructsWhatItProjected) {
  const test::TempDir dir;
  image::Image grey(32, 16, 1);
  for (float& x : grey.pixels) x = 0.25f;
  image::write_image(dir / "in.exr", grey);
  run_sh_project(
      {.image = dir / "in.exr", .layout = image::Layout::equirect, .degree = 2, .output = dir / "l.json"});
  ShReconstructOptions options{.file = dir / "l.json", .output = dir / "out.exr"};
  options.size = 8;
  // A constant has band 0 alone; sums in single precision leave some parts in a million.
  const image::Image picture = run_sh_reconstruct(options).picture;
  EXPECT_EQ(picture.height, 8);
  for (const float x : picture.pixels) ASSERT_NEAR(x, 0.25f, 0.25e-5f);
  EXPECT_EQ(image::read_image(options.output).pixels, picture.pixels);
  options.irradiance = true;
  for (const float x : run_sh_reconstruct(options).picture.pixels) ASSERT_NEAR(x, 0.25f * pi, 0.8e-5f);
}

TEST(Commands, ShRefusesNumbersThatAreTooFew) {
  EXPECT_THAT(message_of([] { run_sh_eval({.degree = 1, .direction = {}}); }),
              HasSubstr("is not a direction"));
  EXPECT_THAT(message_of([] {
                run_sh_irradiance({.file = "-", .normal = {1, 2}});
              }),
              HasSubstr("is not a direction"));
  ShRotateOptions rotate;
  rotate.quaternion = {0, 1};
  EXPECT_THAT(message_of([&] { run_sh_rotate(rotate); }), HasSubstr("is not a rotation"));
}

TEST(Commands, ExportWritesAFileThatLoadsAsTheScene) {
  const test::TempDir dir;
  ExportOptions options;
  options.to = "gltf", options.output = dir / "s.glb";
  options.picture.scene.source = "builtin:two-rooms";
  const ExportResult result = run_export(options);
  const scene::Scene scene = scene::make_builtin("two-rooms");
  EXPECT_EQ(result.hash, scene::scene_hash(scene));
  EXPECT_EQ(result.triangles, scene::triangle_count(scene));
  ASSERT_EQ(result.report.files.size(), 1u);
  EXPECT_EQ(result.report.files[0], options.output);
  EXPECT_EQ(scene::scene_hash(scene_io::load_scene(options.output, {})), result.hash);
  options.to = "gltx";
  EXPECT_EQ(message_of([&] { run_export(options); }), "--to gltx: is no format that there is");
  EXPECT_THAT(export_formats(), testing::Contains("gltf"));
}

ReportOptions small_report(const test::TempDir& dir, const char* steps) {
  ReportOptions o;
  o.tool = test::tool_path();
  o.plan = dir / "plan.json", o.output = dir / "out";
  o.commands = {"render"};
  write_file(o.plan, std::string(R"({"scenes": [{"name": "box", "scene": "builtin:box"}], "methods": [)") +
                         steps + "]}");
  return o;
}

TEST(Commands, ReportRunsWhatIsNotFinished) {
  const test::TempDir dir;
  const char* one =
      R"({"name": "a", "steps": ["render {scene} --width 2 --height 2 -o o.exr"], "picture": "o.exr"})";
  ReportOptions options = small_report(dir, one);
  const ReportResult first = run_report(options);
  EXPECT_TRUE(first.changed);
  EXPECT_EQ(first.commands, 1u);
  EXPECT_EQ(first.run, 1u);
  EXPECT_EQ(first.cells, 1u);
  EXPECT_EQ(first.failed, 0u);
  EXPECT_EQ(first.cache, dir / "cache");
  EXPECT_EQ(first.page_bytes, read_file(dir / "out/report.html").size());
  EXPECT_FALSE(has_failed(first, options));
  EXPECT_NE(report::identity_of(read_text_file(dir / "out/report.json")), "");

  const ReportResult second = run_report(options);
  EXPECT_FALSE(second.changed);
  EXPECT_EQ(second.commands, 1u);
  EXPECT_EQ(second.run + second.cached + second.cells, 0u);

  const std::string bad =
      R"(, {"name": "b", "steps": ["render {scene} --camera no -o o.exr"], "picture": "o.exr"})";
  options = small_report(dir, (one + bad).c_str());
  testing::internal::CaptureStderr();
  const ReportResult third = run_report(options);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("no camera"));
  EXPECT_EQ(third.cached, 1u);
  EXPECT_EQ(third.run, 0u);
  EXPECT_EQ(third.failed, 1u);
  EXPECT_TRUE(has_failed(third, options));
  EXPECT_EQ(report::identity_of(read_text_file(dir / "out/report.json")), "") << "it is tried again";
  options.commands = {"bake"};
  EXPECT_THAT(message_of([&] { run_report(options); }), HasSubstr("render"));
}

}  // namespace
}  // namespace ssphh::app
