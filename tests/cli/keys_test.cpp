// The JSON keys that scripts rely on, for every command, and that nothing else stands on stdout.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::expect_keys;
using test::run_json;
using test::run_tool;
using test::TempDir;
using test::ToolResult;

TEST(Keys, EveryCommandHasHelp) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{{},
                                                                                       {"scene"},
                                                                                       {"scene", "list"},
                                                                                       {"scene", "info"},
                                                                                       {"export"},
                                                                                       {"truth"},
                                                                                       {"render"},
                                                                                       {"bake"},
                                                                                       {"place"},
                                                                                       {"hier"},
                                                                                       {"probe"},
                                                                                       {"probe", "info"},
                                                                                       {"probe", "preview"},
                                                                                       {"probe", "lint"},
                                                                                       {"sh"},
                                                                                       {"sh", "eval"},
                                                                                       {"sh", "project"},
                                                                                       {"sh", "reconstruct"},
                                                                                       {"sh", "irradiance"},
                                                                                       {"sh", "rotate"},
                                                                                       {"sh", "convert"},
                                                                                       {"cubemap"},
                                                                                       {"cubemap", "convert"},
                                                                                       {"compare"},
                                                                                       {"leak"},
                                                                                       {"measure"},
                                                                                       {"relight"}}) {
    std::vector<std::string> arguments = command;
    arguments.emplace_back("--help");
    const ToolResult result = run_tool(arguments);
    EXPECT_EQ(result.exit_code, 0) << testing::PrintToString(command);
    EXPECT_THAT(result.out, testing::HasSubstr("Usage")) << testing::PrintToString(command);
  }
}

TEST(Keys, WithoutAWordTheToolPrintsItsHelp) {
  const ToolResult bare = run_tool({}), asked = run_tool({"--help"});
  EXPECT_EQ(bare.exit_code, 0);
  EXPECT_EQ(bare.out, asked.out);
  EXPECT_THAT(bare.out, testing::HasSubstr("Usage"));
}

TEST(Keys, SceneInfo) {
  const json::Value info = run_json({"scene", "info", "builtin:two-rooms"});
  expect_keys(info, {"triangles", "instances", "materials", "textures", "lights", "cameras", "sphls",
                     "movable", "ignored"});
  EXPECT_GT(info["movable"].number(), 0) << "the door";
  EXPECT_GE(info["sphls"].number(), 4);
}

TEST(Keys, FromSceneToComparedPicture) {
  const TempDir dir;
  const std::string probes = dir / "a.sphl.json", lit = dir / "b.sphl", sheet = dir / "sheet.png";
  const std::string path = dir / "path.exr", ssphh = dir / "ssphh.exr", png = dir / "ssphh.png";

  const json::Value bake =
      run_json({"bake", "builtin:cornell", "-o", probes, "--degree", "4", "--face", "8", "--spp", "2",
                "--records", "256", "--directions", "64", "--surfel-size", "0.2"});
  expect_keys(bake, {"probes", "gen_seconds", "viz_seconds", "rays"});
  EXPECT_GE(bake["probes"].number(), 4);
  const json::Value hier =
      run_json({"hier", probes, "-o", lit, "--operator", "mean", "--neighbors", "2", "--threshold", "0"});
  expect_keys(hier, {"seconds", "edges", "operator"});
  EXPECT_EQ(hier["operator"], "mean");
  run_json({"probe", "info", lit});
  run_json({"probe", "preview", lit, "-o", sheet});
  EXPECT_TRUE(std::filesystem::exists(sheet));

  const std::vector<std::string> size = {"--width", "32", "--height", "18", "--spp", "2"};
  std::vector<std::string> arguments = {"render", "builtin:cornell", "-o", path, "--method", "path"};
  arguments.insert(arguments.end(), size.begin(), size.end());
  expect_keys(run_json(arguments), {"seconds", "rays", "paths", "mean"});
  arguments = {"render", "builtin:cornell", "-o", ssphh, "--png", png, "--method", "ssphh", "--probes", lit};
  arguments.insert(arguments.end(), size.begin(), size.end());
  expect_keys(run_json(arguments), {"seconds", "rays", "paths", "mean"});
  EXPECT_TRUE(std::filesystem::exists(png));

  const json::Value compare = run_json({"compare", path, ssphh, "--block", "8", "-o", dir / "diff.png"});
  expect_keys(compare, {"mae", "rmse", "mse", "relmse", "mape", "smape", "mean_ratio", "psnr", "ssim", "flip",
                        "width", "height"});
  EXPECT_EQ(compare["width"], 32);
  EXPECT_EQ(compare["height"], 18);
  EXPECT_EQ(compare["mean_ratio"].size(), 3u);
  EXPECT_EQ(compare["flip"]["kind"], "hdr");
}

TEST(Keys, ShEvalGivesTheFirstBands) {
  const json::Value eval = run_json({"sh", "eval", "--degree", "1", "--direction", "0", "1", "0"});
  EXPECT_EQ(eval["degree"], 1);
  ASSERT_EQ(eval["values"].size(), 4u);
  EXPECT_NEAR(eval["values"][0].number(), 0.282095, 1e-6);
  EXPECT_NEAR(eval["values"][1].number(), 0.488603, 1e-6);  // Y₁₋₁ = 0.488603 y
  EXPECT_NEAR(eval["values"][2].number(), 0, 1e-6);
}

TEST(Keys, ShProjectFeedsTheOtherShCommands) {
  const TempDir dir;
  const std::string strip = dir / "strip.exr", coefficients = dir / "c.json", image = dir / "back.exr";
  // Closed box, Le = 1, depth 0: radiance 1 in every direction, without noise.
  run_json({"render", "builtin:box", "-o", strip, "--projection", "cube", "--width", "96", "--height", "16",
            "--max-depth", "0", "--spp", "1"});
  const json::Value project =
      run_json({"sh", "project", strip, "--layout", "strip-h", "--degree", "2", "-o", coefficients});
  expect_keys(project, {"degree", "coefficients"});
  ASSERT_EQ(project["coefficients"].size(), 9u);
  // √4π to the five digits of the file, no higher band.
  EXPECT_NEAR(project["coefficients"][0][0].number(), 3.5449077, 5e-5);
  EXPECT_NEAR(project["coefficients"][1][0].number(), 0, 5e-5);
  const json::Value irradiance = run_json({"sh", "irradiance", coefficients, "--normal", "0", "0", "1"});
  ASSERT_EQ(irradiance["irradiance"].size(), 3u);
  EXPECT_NEAR(irradiance["irradiance"][0].number(), 3.14159265, 5e-5);
  run_json({"sh", "reconstruct", coefficients, "-o", image, "--layout", "equirect", "--size", "16"});
  EXPECT_TRUE(std::filesystem::exists(image));
  expect_keys(run_json({"sh", "rotate", coefficients, "--axis", "0", "1", "0", "--angle", "90"}),
              {"degree", "coefficients"});
  run_json({"sh", "convert", coefficients, "--from", "ssphh", "--to", "unity"});
  run_json({"cubemap", "convert", strip, "-o", dir / "cross.exr", "--from", "strip-h", "--to", "cross-v"});
}

}  // namespace
}  // namespace ssphh
