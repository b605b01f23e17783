// `ssphh render` and `ssphh truth`: pictures are those of the library with the options that were given,
// figures those of the pictures.

#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include <ssphh/image/exposure.h>
#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/lambertian.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/study/default_view.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "here.h"
#include "options/render_options.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using image::Image;
using test::joined;
using test::json_here;
using test::problem_here;
using test::text_here;
using testing::AllOf;
using testing::HasSubstr;

/// builtin:two-rooms with its door half open, as options and by the library.
class Render : public testing::Test {
 protected:
  Render() {
    params_.width = 12, params_.height = 8;
    params_.path = {.max_depth = 2, .passes = 3, .spp = 2, .seed = 5};
    params_.camera = scene::camera_pose(scene_, "room-b", 0.5f);
  }
  /// Of `more`, what the base has too stands in its place.
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"render", "builtin:two-rooms"};
    for (const auto& [option, value] :
         std::vector<std::pair<std::string, std::string>>{{"-o", out_},
                                                          {"--time", "0.5"},
                                                          {"--camera", "room-b"},
                                                          {"--width", "12"},
                                                          {"--height", "8"},
                                                          {"--max-depth", "2"},
                                                          {"--passes", "3"},
                                                          {"--spp", "2"},
                                                          {"--seed", "5"}})
      if (std::ranges::find(more, option) == more.end()) words = joined(words, {option, value});
    return joined(words, more);
  }
  trace::RenderState traced() const {
    trace::RenderState state;
    trace::PathTracer(scene_, 0.5f).render(params_, state);
    return state;
  }
  Image picture() const { return trace::resolve(traced().color, 3); }

  const test::TempDir dir_;
  const std::string out_ = dir_ / "o.exr";
  scene::Scene scene_ = scene::make_builtin("two-rooms");
  trace::RenderParams params_;
};

TEST_F(Render, WritesThePictureThatWasAskedForAndTellsItsMean) {
  const json::Value result = json_here(command({"--aov", "direct,normal"}));
  const trace::RenderState state = traced();
  const Image wanted = trace::resolve(state.color, 3), written = image::read_image(out_);
  EXPECT_EQ(written.pixels, wanted.pixels);
  EXPECT_EQ(image::read_image(dir_ / "o.direct.exr").pixels, trace::resolve(state.direct, 3).pixels);
  EXPECT_EQ(image::read_image(dir_ / "o.normal.exr").pixels, trace::resolve(state.normal, 3).pixels);
  EXPECT_EQ(result["output"], out_);
  EXPECT_EQ(result["method"], "path");
  EXPECT_EQ(result["width"], 12);
  EXPECT_EQ(result["height"], 8);
  EXPECT_EQ(result["passes"], 3);
  EXPECT_EQ(result["paths"], 12 * 8 * 3 * 2);
  EXPECT_EQ(result["rays"], state.rays);
  EXPECT_GT(result["seconds"].number(), 0);
  glm::dvec3 sum(0);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 12; ++x) sum += glm::dvec3(wanted.rgb(x, y));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(result["mean"][c].number(), sum[c] / 96, 1e-12);
  EXPECT_THAT(text_here(command()),
              testing::MatchesRegex(".*o.exr: 12×8, 576 paths, [0-9]+ rays in [0-9.]+ s, mean radiance .*"));
}

TEST_F(Render, ProjectionsAreThoseOfTheWholeSphere) {
  params_.projection = trace::Projection::equirect;
  json_here(command({"--projection", "equirect"}));
  EXPECT_EQ(image::read_image(out_).pixels, picture().pixels);
  // Where an SPHL stands, its axes the world's.
  const scene::ProbePlace sphl = scene::sphl_places(scene_, 0.5f)[1];
  params_.camera.world = mat4(1);
  params_.camera.world[3] = vec4(sphl.position, 1);
  json_here(command({"--projection", "equirect", "--at", sphl.name}));
  EXPECT_EQ(image::read_image(out_).pixels, picture().pixels);
  params_.camera.world[3] = vec4(-1.5f, 1, 0.25f, 1);
  params_.projection = trace::Projection::cube_strip;
  params_.width = 24, params_.height = 4;
  json_here(command({"--projection", "cube", "--at", "-1.5,1,0.25", "--width", "24", "--height", "4"}));
  EXPECT_EQ(image::read_image(out_).pixels, picture().pixels);
  for (const char* bad : {"nobody", "1,2", "1,2,3,4", "1,2,nan", "1,2,3m"})
    EXPECT_THAT(problem_here(command({"--projection", "equirect", "--at", bad})),
                AllOf(HasSubstr("--at " + std::string(bad) + ": is neither a SPHL of the scene nor X,Y,Z"),
                      HasSubstr("its SPHLs: A west, ")));
  EXPECT_THAT(problem_here(command({"--at", "1,2,3"})), HasSubstr("add --projection cube or equirect"));
}

TEST_F(Render, AnOrthographicCameraSeesParallelRays) {
  scene_.cameras[0].orthographic = true, scene_.cameras[0].yheight = 2;
  const std::string name = scene_.cameras[0].name, file = dir_ / "flat.glb";
  scene_io::write_glb(file, scene_);
  scene_ = scene_io::load_scene(file);
  params_.camera = scene::camera_pose(scene_, name, 0.5f);
  ASSERT_TRUE(params_.camera.camera.orthographic);
  params_.projection = trace::Projection::orthographic;
  std::vector<std::string> arguments = command({"--camera", name});
  arguments[1] = file;
  json_here(arguments);
  EXPECT_EQ(image::read_image(out_).pixels, picture().pixels);
}

TEST_F(Render, ASceneWithoutCamerasIsSeenFromWhereItsViewIsFound) {
  scene_.cameras.clear();
  const std::string file = dir_ / "blind.glb";
  scene_io::write_glb(file, scene_);
  scene_ = scene_io::load_scene(file);
  params_.camera = study::default_view(
      scene_, trace::TransportScene(std::make_shared<const trace::SceneGeometry>(scene_), scene_), 0.5f);
  EXPECT_LT(std::abs(params_.camera.world[3].x), 5) << "within the rooms";
  std::vector<std::string> arguments = {"render", file, "--time", "0.5", "-o", out_};
  for (const char* word :
       {"--width", "12", "--height", "8", "--max-depth", "2", "--passes", "3", "--spp", "2", "--seed", "5"})
    arguments.push_back(word);
  EXPECT_EQ(json_here(arguments)["geometry_builds"], 1) << "one for the view and the picture";
  EXPECT_EQ(image::read_image(out_).pixels, picture().pixels);
}

TEST_F(Render, PicturesForScreensAreToneMapped) {
  const auto expect = [&](const std::vector<std::string>& options, const image::ToneMap& how) {
    json_here(command(joined({"--png", dir_ / "o.png"}, options)));
    image::write_image(dir_ / "wanted.png", image::tone_map(picture(), how));
    EXPECT_EQ(image::read_image(dir_ / "o.png").pixels, image::read_image(dir_ / "wanted.png").pixels);
    EXPECT_EQ(image::read_image(out_).pixels, picture().pixels) << "linear radiance stays";
  };
  const float suits = image::automatic_exposure(picture());
  EXPECT_NE(suits, 0);
  expect({}, {.exposure = suits});
  expect({"--exposure", "auto"}, {.exposure = suits});
  expect({"--exposure", "0"}, {});
  expect({"--exposure", "2.5"}, {.exposure = 2.5f});
  expect({"--exposure", "-1.5"}, {.exposure = -1.5f});
  expect({"--tonemap", "filmic", "--exposure", "1"}, {.exposure = 1, .curve = image::ToneCurve::filmic});
  json_here(command({"-o", dir_ / "direct.png", "--exposure", "1"}));
  image::write_image(dir_ / "wanted.png", image::tone_map(picture(), {.exposure = 1}));
  EXPECT_EQ(image::read_image(dir_ / "direct.png").pixels, image::read_image(dir_ / "wanted.png").pixels);
}

TEST_F(Render, TheExposureIsToldWhereAPictureIsToneMapped) {
  const float suits = image::automatic_exposure(picture());
  const std::string png = dir_ / "o.png";
  EXPECT_EQ(json_here(command({"--png", png}))["exposure"], suits);
  EXPECT_EQ(json_here(command({"--png", png, "--exposure", "+3"}))["exposure"], 3);
  EXPECT_FALSE(json_here(command({})).contains("exposure")) << "EXR stays linear";
  EXPECT_THAT(text_here(command({"--png", png})),
              testing::EndsWith(fmt::format(", exposure {:+.2f} EV", suits)));
}

TEST_F(Render, OptionsOfTheSceneChangeIt) {
  scene_ = scene::lambertian(std::move(scene_));
  json_here(command({"--lambert"}));
  EXPECT_EQ(image::read_image(out_).pixels, picture().pixels);
}

TEST_F(Render, ACheckpointOfAnotherPictureIsNotContinued) {
  // A finished run leaves none.
  json_here(command());
  EXPECT_FALSE(std::filesystem::exists(out_ + ".state"));
  std::ofstream(out_ + ".state") << "no state";
  EXPECT_THAT(problem_here(command({"--resume"})), HasSubstr("o.exr.state"));
  json_here(command());
  EXPECT_FALSE(std::filesystem::exists(out_ + ".state"));
}

TEST_F(Render, MethodIsSsphhWhereOpenGlDrawsOrProbesAreGiven) {
  EXPECT_EQ(json_here(command())["method"], "path");
  EXPECT_EQ(json_here(command({"--backend", "gl", "--max-depth", "1"}))["method"], "ssphh");
  EXPECT_THAT(problem_here(command({"--probes", "x.sphl"})), HasSubstr("x.sphl"));
  app::RenderOptions options;
  EXPECT_EQ(app::method_of(options), "path");
  options.probes = "a.sphl";
  EXPECT_EQ(app::method_of(options), "ssphh");
  options.method = "path";
  EXPECT_EQ(app::method_of(options), "path");
}

TEST_F(Render, OptionsThatHaveNoEffectAreRefused) {
  EXPECT_THAT(problem_here(command({"--method", "path", "--probes", "x.sphl"})),
              HasSubstr("is of method ssphh, not of path"));
  EXPECT_THAT(problem_here(command({"--param", "a=1"})), HasSubstr("method path has none"));
  EXPECT_THAT(problem_here(command({"--method", "ssphh", "--probes", "x.sphl", "--param", "a=1"})),
              HasSubstr("leave out one of them"));
  EXPECT_THAT(problem_here(command({"--method", "vpl", "--local", "1"})), HasSubstr("in this process only"));
  EXPECT_THAT(problem_here(command({"--occlusion", "0.01"})), HasSubstr("--occlusion"));
  EXPECT_THAT(problem_here(command({"--indirect-scale", "2"})), HasSubstr("--indirect-scale"));
  EXPECT_THAT(problem_here(command({"--local", "1", "--resume"})), HasSubstr("a farm keeps finished tiles"));
  const auto gl = [&](const std::vector<std::string>& more) {
    return problem_here(command(joined({"--backend", "gl"}, more)));
  };
  EXPECT_THAT(
      gl({"--method", "path"}),
      AllOf(HasSubstr("--method path: path tracing is not for --backend gl"), HasSubstr("leave it out")));
  EXPECT_THAT(gl({"--method", "ddgi"}), HasSubstr("--method ddgi: has no OpenGL version"));
  EXPECT_THAT(gl({"--method", "direct", "--projection", "equirect"}), HasSubstr("--projection"));
  EXPECT_THAT(gl({"--method", "direct", "--resume"}), HasSubstr("--resume"));
  EXPECT_THAT(gl({"--method", "direct", "--local", "1"}), HasSubstr("--broker or --local: a farm"));
  EXPECT_THAT(gl({"--method", "vpl", "--probes", "x.sphl"}), HasSubstr("is of method ssphh, not of vpl"));
  EXPECT_THAT(gl({"--method", "ssphh", "--param", "weights=gather"}), HasSubstr("only the CPU"));
  for (const char* aov : {"depth", "groups"})
    EXPECT_THAT(gl({"--method", "direct", "--aov", aov}), HasSubstr("--aov: " + std::string(aov)));
}

// Two halves with seeds of their own, half of the samples each.
TEST_F(Render, TruthIsTheMeanOfTwoHalves) {
  const auto half = [&](std::uint64_t seed) {
    params_.path = {.max_depth = 2, .passes = 1, .spp = 3, .seed = seed};
    trace::RenderState state;
    trace::PathTracer(scene_, 0.5f).render(params_, state);
    return trace::resolve(state.color, 1);
  };
  const std::vector<std::string> truth = {
      "truth",   "builtin:two-rooms", "-o", out_,          "--time", "0.5",   "--camera", "room-b", "--width",
      "12",      "--height",          "8",  "--max-depth", "2",      "--spp", "7",        "--seed", "5",
      "--halves"};
  for (const bool sphere : {false, true}) {
    if (sphere) params_.projection = trace::Projection::equirect;
    const json::Value result = json_here(sphere ? joined(truth, {"--projection", "equirect"}) : truth);
    const Image a = half(10), b = half(11);
    EXPECT_EQ(image::read_image(dir_ / "o.a.exr").pixels, a.pixels);
    EXPECT_EQ(image::read_image(dir_ / "o.b.exr").pixels, b.pixels);
    Image mean = a;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) mean.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
    EXPECT_EQ(image::read_image(out_).pixels, mean.pixels);
    const metrics::ImageError noise = metrics::compare(mean, a);
    EXPECT_EQ(result["noise"],
              json::Value({{"mse", noise.mse}, {"rmse", noise.rmse}, {"relmse", noise.relmse}}));
    EXPECT_EQ(result["spp"], 6) << "an even number";
    EXPECT_EQ(result["max_depth"], 2);
    EXPECT_EQ(result["width"], 12);
    EXPECT_EQ(result["height"], 8);
    EXPECT_EQ(result["renderer"], "path");
    EXPECT_EQ(result["projection"], sphere ? "equirect" : "camera");
    EXPECT_TRUE(result["differences"].empty());
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0, squares = 0;
      for (std::size_t i = c; i < a.pixels.size(); i += 3) {
        sum += 0.5 * (static_cast<double>(a.pixels[i]) + b.pixels[i]);
        squares += std::pow(0.5 * (static_cast<double>(a.pixels[i]) - b.pixels[i]), 2);
      }
      EXPECT_NEAR(result["mean"][c].number(), sum / 96, 1e-9);
      EXPECT_NEAR(result["standard_error"][c].number(), std::sqrt(squares) / 96, 1e-9);
    }
  }
  EXPECT_THAT(text_here(truth), HasSubstr("12×8, 6 samples per pixel, depth 2, by path in "));
  EXPECT_THAT(problem_here(joined(truth, {"--renderer", "cycles", "--local", "1"})),
              HasSubstr("is not for a farm"));
}

}  // namespace
}  // namespace ssphh
