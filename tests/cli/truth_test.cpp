// Scenes for other renderers, and Cycles as a second truth where Blender is installed.

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>

#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::expect_keys;
using test::run_json;
using test::run_tool;
using test::TempDir;

const json::Value read_json(const std::filesystem::path& path) {
  return test::parse_json_if_any(read_text_file(path));
}

TEST(Export, CyclesGetsTheSceneInWorldSpaceAndTheReportNamesWhatDiffers) {
  const TempDir dir;
  const json::Value plain =
      run_json({"export", "builtin:two-rooms", "--to", "cycles", "-o", dir / "a", "--time", "1"});
  expect_keys(plain, {"to", "files", "command", "differences", "triangles", "hash"});
  EXPECT_TRUE(plain["differences"].empty()) << print(plain["differences"]);
  const json::Value scene = read_json(dir / "a/scene.json");
  ASSERT_TRUE(scene.is_object());
  EXPECT_EQ(scene["lights"].size(), 1u);
  std::size_t triangles = 0, floats = 0;
  for (const json::Value& mesh : scene["meshes"].elements()) {
    triangles += test::count_of(mesh["triangles"]);
    floats += 3 * test::count_of(mesh["vertices"]) + 3 * test::count_of(mesh["triangles"]);
    if (mesh.contains("normals")) floats += 3 * test::count_of(mesh["vertices"]);
    for (const char* uv : {"uv0", "uv1"})
      if (mesh.contains(uv)) floats += 2 * test::count_of(mesh["vertices"]);
  }
  EXPECT_EQ(triangles, plain["triangles"]);
  EXPECT_EQ(std::filesystem::file_size(dir / "a/scene.bin"), 4 * floats);

  const json::Value bronze = run_json({"export", "builtin:gallery2", "--to", "cycles", "-o", dir / "b"});
  ASSERT_EQ(bronze["differences"].size(), 1u);
  EXPECT_THAT(bronze["differences"][0].string(), testing::HasSubstr("bronze"));
}

TEST(Export, EveryRendererGetsItsFilesAndTheReportNamesWhatDiffers) {
  const TempDir dir;
  for (const char* renderer : {"mitsuba", "pbrt", "corona"}) {
    const json::Value written =
        run_json({"export", "builtin:gallery2", "--to", renderer, "-o", dir / renderer});
    EXPECT_EQ(written["to"], renderer);
    for (const json::Value& file : written["files"].elements())
      EXPECT_TRUE(std::filesystem::is_regular_file(file.string()));
    EXPECT_THAT(written["command"].string(), testing::HasSubstr(written["files"][0].string()));
    EXPECT_THAT(print(written["differences"]), testing::HasSubstr("bronze")) << renderer;
  }
}

TEST(Export, GltfLoadsBackTheSame) {
  const TempDir dir;
  const json::Value written =
      run_json({"export", "builtin:two-rooms", "--to", "gltf", "-o", dir / "rooms.glb"});
  EXPECT_EQ(run_json({"scene", "info", dir / "rooms.glb"})["hash"], written["hash"]);
}

TEST(Truth, TellsItsOwnNoise) {
  const TempDir dir;
  const std::vector<std::string> common = {"truth",    "builtin:box", "--width",     "32",
                                           "--height", "18",          "--max-depth", "3"};
  const auto truth = [&](const std::string& spp, const std::string& name) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"--spp", spp, "-o", dir / name, "--halves"});
    return run_json(arguments);
  };
  const json::Value few = truth("8", "few.exr"), many = truth("128", "many.exr");
  expect_keys(few, {"output", "renderer", "seconds", "mean", "standard_error", "noise", "differences"});
  // Sixteen times the samples: a quarter of the RMSE, somewhat less with stratified samples.
  EXPECT_LT(many["noise"]["rmse"].number(), 0.5 * few["noise"]["rmse"].number());
  const json::Value halves = run_json({"compare", dir / "few.a.exr", dir / "few.b.exr"});
  EXPECT_NEAR(halves["rmse"].number() / 2, few["noise"]["rmse"].number(), 1e-7);
}

bool blender_is_there() {
  return std::system("command -v blender > /dev/null") == 0;
}

// Lambert surfaces and a point light: two bounces agree within the noise of both and 1 % per channel.
TEST(Truth, CyclesAgrees) {
  if (!blender_is_there()) GTEST_SKIP() << "no blender: scripts/install-deps --with-blender";
  const TempDir dir;
  const auto truth = [&](const std::string& renderer) {
    return run_json({"truth", "builtin:two-rooms", "--renderer", renderer, "--max-depth", "3", "--spp", "64",
                     "--width", "80", "--height", "45", "-o", dir / (renderer + ".exr")});
  };
  const json::Value ours = truth("path"), cycles = truth("cycles");
  EXPECT_TRUE(cycles["differences"].empty());
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = ours["mean"][c].number(), b = cycles["mean"][c].number();
    EXPECT_NEAR(b / a, 1, 0.01);
    const double error = std::hypot(ours["standard_error"][c].number(), cycles["standard_error"][c].number());
    EXPECT_LT(std::abs(b - a), 5 * error + 0.002 * a);  // pixel edges: 0.2 %
  }
}

/// Means of green over the middle of a picture of builtin:furnace and over its limb, seen at 60 to 80
/// degrees.
std::array<double, 2> middle_and_limb(const image::Image& picture) {
  std::array<double, 2> sum{}, count{};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double r = std::hypot(x + 0.5 - picture.width / 2.0, y + 0.5 - picture.height / 2.0);
      const bool middle = r < 3.5, limb = r >= 7.5 && r < 8.5;  // of 24 pixels
      if (!middle && !limb) continue;
      sum[limb] += static_cast<double>(picture.rgb(x, y).y);
      count[limb] += 1;
    }
  }
  return {sum[0] / count[0], sum[1] / count[1]};
}

// In an even environment of 1 a surface shows its albedo, and a white one shows 1 whatever its lobe: light
// that the lobe does not reflect reaches the layer under it. Cycles' lobes must keep that at every view
// angle.
TEST(Truth, CyclesLosesNoLightOfRoughLobes) {
  if (!blender_is_there()) GTEST_SKIP() << "no blender: scripts/install-deps --with-blender";
  const TempDir dir;
  const auto truth = [&](const std::string& renderer, const std::string& material) {
    const std::string scene = dir / "ball.ssphh.json", output = dir / (renderer + ".exr");
    std::ofstream(scene) << R"({"scene": "builtin:furnace", "materials": [{"name": "half", )" << material
                         << "}]}";
    run_json({"truth", scene, "--renderer", renderer, "--width", "24", "--height", "24", "--spp", "64",
              "--max-depth", "1", "-o", output});
    return middle_and_limb(image::read_image(output));
  };
  const auto white = truth("cycles", R"("specular": 1, "base_color": [1, 1, 1], "specular_roughness": 1)");
  EXPECT_NEAR(white[0], 1, 0.01);
  EXPECT_NEAR(white[1], 1, 0.02);
  for (const char* material :
       {R"("specular": 1, "base_color": [0.3, 0.3, 0.3], "specular_roughness": 0.6)",
        R"("specular": 1, "base_color": [0.3, 0.3, 0.3], "specular_roughness": -0.6)"}) {
    const auto ours = truth("path", material), cycles = truth("cycles", material);
    EXPECT_NEAR(cycles[0], ours[0], 0.01) << material;
    EXPECT_NEAR(cycles[1], ours[1], 0.01) << material;
  }
}

// Direct light on the whole sphere: a picture that is turned or mirrored would differ by far more than noise.
TEST(Truth, CyclesAgreesOnTheWholeSphere) {
  if (!blender_is_there()) GTEST_SKIP() << "no blender: scripts/install-deps --with-blender";
  const TempDir dir;
  const auto truth = [&](const std::string& renderer) {
    const std::string output = dir / (renderer + ".exr");
    run_json({"truth", "builtin:two-rooms", "--renderer", renderer, "--projection", "equirect", "--max-depth",
              "1", "--spp", "64", "--width", "64", "--height", "32", "-o", output});
    return image::read_image(output);
  };
  const image::Image ours = truth("path"), cycles = truth("cycles");
  ASSERT_EQ(cycles.width, 64);
  double difference = 0, mirrored = 0, turned = 0, total = 0;
  glm::dvec3 sum_of_ours(0), sum_of_cycles(0);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const vec3 a = ours.rgb(x, y);
      const auto distance = [&](int u, int v) {
        return static_cast<double>(glm::length(cycles.rgb(u, v) - a));
      };
      sum_of_ours += glm::dvec3(a);
      sum_of_cycles += glm::dvec3(cycles.rgb(x, y));
      total += static_cast<double>(glm::length(a));
      difference += distance(x, y);
      mirrored += distance(63 - x, y);
      turned += distance((x + 16) % 64, y);
    }
  }
  EXPECT_GT(total, 0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum_of_cycles[c] / sum_of_ours[c], 1, 0.01);
  EXPECT_LT(difference, 0.03 * total);  // edges within pixels and noise
  EXPECT_GT(mirrored, 0.2 * total);
  EXPECT_GT(turned, 0.2 * total);
}

}  // namespace
}  // namespace ssphh
