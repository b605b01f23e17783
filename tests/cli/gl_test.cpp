// The commands that draw with OpenGL, as a user types them.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/image/io.h>

#include "gl_context.h"
#include "here.h"
#include "results/pictures.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::expect_failure;
using test::expect_keys;
using test::joined;
using test::run_json;
using test::TempDir;

/// The tool makes a context of its own; this one tells whether it can.
class GlTool : public test::WithGl {};

const std::vector<std::string> tiny = {"--width", "48", "--height", "27"};

TEST_F(GlTool, BenchFrameTellsTimesOfPasses) {
  const json::Value bench = run_json(joined({"bench-frame", "builtin:cornell", "--frames", "3"}, tiny));
  expect_keys(bench, {"median_ms", "p99_ms", "passes", "renderer", "width", "height", "memory_growth_bytes"});
  EXPECT_EQ(bench["frames"], 3);
  EXPECT_EQ(bench["probes"], 0);
  EXPECT_FALSE(bench.contains("sphl_ratio"));
  for (const char* pass : {"geometry", "direct", "shadows"})
    EXPECT_TRUE(bench["passes"].contains(pass)) << pass;
  EXPECT_FALSE(bench["passes"].contains("indirect"));
}

TEST_F(GlTool, BenchFrameTellsHowOftenASampleIsShaded) {
  const auto overdraw = [](const std::vector<std::string>& arguments) -> double {
    return run_json(joined(arguments, tiny))["overdraw"].number();
  };
  // Within a closed convex room each sample is shaded once, however many a pixel has
  const std::vector<std::string> inside = {"bench-frame", "builtin:box", "--frames", "2"};
  EXPECT_EQ(overdraw(inside), 1);
  EXPECT_EQ(overdraw(joined(inside, {"--samples", "3"})), 1);
  // A room seen from before its open side; once the camera has turned away, nothing is. Counts come late: the
  // last of four frames tells of one a quarter or half a turn on
  const std::vector<std::string> outside = {"bench-frame", "builtin:cornell", "--frames", "4"};
  const double seen = overdraw(outside);
  EXPECT_GT(seen, 0.1);
  EXPECT_LT(seen, 1);
  EXPECT_EQ(overdraw(joined(outside, {"--turn"})), 0);
}

TEST_F(GlTool, BenchFrameComparesWithDirectLightAlone) {
  const TempDir dir;
  run_json({"bake", "builtin:two-rooms", "-o", dir / "a.sphl", "--degree", "1", "--face", "4", "--spp", "1",
            "--viz", "off", "--records", "0"});
  const json::Value bench = run_json(joined(
      {"bench-frame", "builtin:two-rooms", "--probes", dir / "a.sphl", "--frames", "3", "--ratio", "--move"},
      tiny));
  EXPECT_EQ(bench["probes"], 6);
  EXPECT_EQ(bench["indirect_scale"], 3) << "as in the viewer";
  EXPECT_TRUE(bench["passes"].contains("indirect"));
  EXPECT_NEAR(bench["sphl_ratio"].number(),
              bench["median_ms"].number() / bench["direct_only_median_ms"].number(), 1e-6);
  expect_failure({"bench-frame", "builtin:two-rooms", "--ratio"}, "--probes");
}

TEST_F(GlTool, LightAtSomePixelsIsOfTheRealTimeRenderer) {
  const TempDir dir;
  expect_failure(
      {"render", "builtin:cornell", "--method", "direct", "--indirect-scale", "3", "-o", dir / "a.exr"},
      "--backend gl");
  EXPECT_FALSE(std::filesystem::exists(dir / "a.exr"));
  const json::Value done = run_json(joined(
      {"render", "builtin:cornell", "--method", "vpl", "--param", "photons=8", "--param", "check_points=0",
       "--spp", "2", "--passes", "2", "--backend", "gl", "--indirect-scale", "3", "-o", dir / "b.exr"},
      tiny));
  EXPECT_EQ(done["backend"], "gl");
  EXPECT_EQ(done["samples"], 4) << "a square of at least as many as the paths asked for";
  EXPECT_TRUE(std::filesystem::exists(dir / "b.exr"));
}

TEST_F(GlTool, EveryKindOfWeightsIsDrawnAsTheCpuDoes) {
  const TempDir dir;
  const std::string file = dir / "a.sphl";
  run_json({"bake", "builtin:box", "-o", file, "--operator", "surfel", "--directions", "64", "--surfel-size",
            "0.3", "--link-rays", "16", "--viz", "off", "--fit", "--records", "0"});
  const auto mean = [&](const std::vector<std::string>& more) {
    return run_json(joined(joined({"render", "builtin:box", "--method", "ssphh", "--probes", file, "-o",
                                   dir / "x.exr", "--spp", "16"},
                                  tiny),
                           more))["mean"][0]
        .number();
  };
  std::map<std::string, double> drawn;
  for (const char* weights : {"fitted", "mls", "trilinear", "distance"}) {
    drawn[weights] = mean({"--weights", weights, "--backend", "gl"});
    // 1300 pixels, 16 paths each, of soft light: noise of the mean is well under 1 %
    EXPECT_NEAR(drawn[weights] / mean({"--weights", weights}), 1, 0.01) << weights;
  }
  EXPECT_NE(drawn["fitted"], drawn["mls"]);
  EXPECT_EQ(mean({"--backend", "gl"}), drawn["fitted"]);
  run_json({"bake", "builtin:box", "-o", file, "--degree", "1", "--face", "4", "--spp", "1", "--viz", "off",
            "--records", "0"});
  expect_failure({"render", "builtin:box", "--method", "ssphh", "--backend", "gl", "--probes", file,
                  "--weights", "fitted", "-o", dir / "x.exr"},
                 {"has no fitted weights", "--fit"});
}

TEST_F(GlTool, WithoutAProbeFileMakesTheProbesThatTheCpuMakes) {
  const TempDir dir;
  const auto render = [&](const std::vector<std::string>& more) {
    return run_json(joined(joined({"render", "builtin:box", "--method", "ssphh", "--param", "probes=8",
                                   "--param", "surfel_size=0.2", "--param", "directions=128", "-o",
                                   dir / "x.exr", "--spp", "16", "--aov", "indirect"},
                                  tiny),
                           more));
  };
  std::map<std::string, double> means;
  for (const char* weights : {"surface", "fitted"}) {
    const std::vector<std::string> chosen = {"--param", "weights=" + std::string(weights)};
    const json::Value drawn = render(joined(chosen, {"--backend", "gl"}));
    const auto of_drawn = app::mean_radiance(image::read_image(dir / "x.indirect.exr"));
    const json::Value traced = render(chosen);
    const auto of_traced = app::mean_radiance(image::read_image(dir / "x.indirect.exr"));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(of_drawn[c] / of_traced[c], 1, 0.01) << weights << c;
    EXPECT_EQ(drawn["probes"], traced["probes"]);
    EXPECT_EQ(drawn["geometry_builds"], 1);
    means[weights] = of_drawn[0];
  }
  EXPECT_NE(means["surface"], means["fitted"]);
}

TEST_F(GlTool, TakesSixteenSamplesAtMostForThePathsAskedFor) {
  const TempDir dir;
  const json::Value done =
      run_json({"render", "builtin:furnace", "--method", "direct", "--backend", "gl", "--width", "8",
                "--height", "8", "--spp", "3", "--passes", "30", "-o", dir / "a.exr"});
  EXPECT_EQ(done["samples"], 16);
}

TEST_F(GlTool, TurntableWritesPicturesFromAllAround) {
  const TempDir dir;
  const json::Value turn = run_json(
      joined({"turntable", "builtin:cornell", "-o", dir / "turn", "--frames", "2", "--samples", "1"}, tiny));
  EXPECT_EQ(turn["frames"], 2);
  const image::Image front = image::read_image(dir / "turn/0000.png"),
                     back = image::read_image(dir / "turn/0001.png");
  EXPECT_EQ(front.width, 48);
  EXPECT_EQ(front.height, 27);
  EXPECT_NE(front.pixels, back.pixels);
  EXPECT_FALSE(std::filesystem::exists(dir / "turn/0002.png"));
  expect_failure({"turntable", "builtin:gallery1", "-o", "/proc/no/such"}, "/proc/no/such");
}

TEST_F(GlTool, NormalsAreThoseOfTheTracedPicture) {
  const TempDir dir;
  for (const std::string how : {"gl", "cpu"})
    run_json(
        joined({"render", "builtin:cornell", "--backend", how, "--method", how == "gl" ? "direct" : "path",
                "--spp", "1", "-o", dir / (how + ".exr"), "--aov", "normal"},
               tiny));
  const image::Image drawn = image::read_image(dir / "gl.normal.exr"),
                     traced = image::read_image(dir / "cpu.normal.exr");
  ASSERT_EQ(drawn.width, traced.width);
  // Edges of the boxes and walls run through some 130 of the 1296 pixels, and each is sampled elsewhere
  int others = 0;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x)
      others += glm::distance(drawn.rgb(x, y), traced.rgb(x, y)) > 0.01f;  // drawn in 16-bit floats
  EXPECT_LT(others, 130);
}

TEST_F(GlTool, DrawsMethodsThatGiveTheirLightAsData) {
  const TempDir dir;
  const auto render = [&](const std::vector<std::string>& more) {
    return run_json(joined(joined({"render", "builtin:cornell", "--backend", "gl", "--spp", "1", "-o",
                                   dir / "a.exr", "--aov", "indirect"},
                                  more),
                           tiny));
  };
  const json::Value cones = render({"--method", "vct", "--param", "resolution=16", "--param", "bounces=1"});
  expect_keys(cones, {"renderer", "bake_seconds", "update_seconds", "lookup_bytes", "gl_bytes", "gl_cones"});
  EXPECT_EQ(cones["gl_cones"], 16);
  EXPECT_EQ(cones["samples"], 1);
  const json::Value lights =
      render({"--method", "vpl", "--param", "photons=16", "--param", "check_points=0"});
  EXPECT_EQ(lights["gl_lights"], lights["vpls"]);
  EXPECT_GT(lights["gl_map_size"].number(), 0);
  const image::Image indirect = image::read_image(dir / "a.indirect.exr");
  EXPECT_GT(*std::ranges::max_element(indirect.pixels), 0);
  EXPECT_FALSE(render({"--method", "direct"}).contains("gl_bytes"));
  const json::Value bench = run_json(joined({"bench-frame", "builtin:cornell", "--method", "vct", "--param",
                                             "resolution=8", "--frames", "2", "--ratio"},
                                            tiny));
  expect_keys(bench, {"method_ratio", "gl_bytes"});
  EXPECT_TRUE(bench["passes"].contains("indirect"));

  const std::vector<std::string> gl = {"render", "builtin:cornell", "--backend", "gl", "-o", dir / "b.exr"};
  expect_failure(joined(gl, {"--method", "ddgi"}), {"ddgi", "no OpenGL version", "vct"});
  expect_failure(joined(gl, {"--method", "vct", "--probes", "x.sphl"}), {"--probes", "vct"});
  expect_failure(joined(gl, {"--method", "ssphh", "--param", "probe=8"}), {"probe", "probes"});
  expect_failure({"bench-frame", "builtin:cornell", "--method", "vpl", "--move"}, {"--move"});
  EXPECT_FALSE(std::filesystem::exists(dir / "b.exr"));
}

TEST(GlToolWithoutGl, AMissingOpenGlIsToldWithWhatToInstall) {
  const TempDir dir;
  // EGL's loader finds its drivers by such files
  ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent/egl.json", 1);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"bench-frame", "builtin:furnace", "--frames", "1"},
        {"turntable", "builtin:furnace", "-o", dir / "turn"},
        {"render", "builtin:furnace", "--method", "ssphh", "--max-depth", "1", "--backend", "gl", "-o",
         dir / "a.png"}})
    expect_failure(command, {"OpenGL", "install a graphics driver"});
  ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  EXPECT_FALSE(std::filesystem::exists(dir / "a.png"));
}

}  // namespace
}  // namespace ssphh
