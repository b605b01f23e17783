// What a user types wrong, what a disk or a file does wrong: a clear message, the right exit code, nothing
// lost.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "here.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::expect_failure;
using test::joined;
using test::run_tool;
using test::TempDir;
using test::ToolProcess;
using test::ToolResult;
using testing::AllOf;
using testing::HasSubstr;

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

const std::vector<std::string> small = {"--width", "16", "--height", "9", "--spp", "1"};

TEST(BadInput, WrongUsageIsExitCode2) {
  expect_failure({"probe"}, "a command is missing: info, preview", 2);
  expect_failure({"nonsense"}, "nonsense", 2);
  expect_failure({"render", "builtin:box"}, "--output", 2);
  expect_failure({"render", "builtin:box", "-o", "x.exr", "--spp", "0"}, "--spp", 2);
  expect_failure({"sh", "eval", "--degree", "11", "--direction", "0", "0", "1"}, "11", 2);
  expect_failure({"bake", "builtin:box", "-o", "x.sphl", "--degree", "11"}, "11", 2);
  expect_failure({"scene", "info", "builtin:box", "--unit", "yard"},
                 "\"yard\" is no unit of length: mm, cm, m, inch, auto", 2);
}

TEST(BadInput, UnknownNamesListTheKnownOnes) {
  for (const char* number : {"nan", "inf", "1e999"})
    expect_failure({"bake", "builtin:box", "-o", "a.sphl", "--threshold", number}, "finite", 2);
  for (const char* option : {"--clearance", "--surfel-size", "--max-memory"})
    expect_failure({"bake", "builtin:box", "-o", "a.sphl", option, "nan"}, option, 2);
  expect_failure({"scene", "info", "builtin:nowhere"}, "cornell");
  const TempDir dir;
  expect_failure(joined({"render", "builtin:two-rooms", "--camera", "nobody", "-o", dir / "x.png"}, small),
                 "room-a");
}

TEST(BadInput, ErrorsAreJsonWhenAskedFor) {
  const ToolResult result = run_tool({"scene", "info", "builtin:nowhere", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(test::parse_json(result.out).contains("error"));
}

TEST(BadInput, BrokenScenesNameFileAndPlace) {
  const TempDir dir;
  expect_failure({"scene", "info", dir / "none.glb"}, "none.glb");
  write(dir / "empty.glb", "");
  expect_failure({"scene", "info", dir / "empty.glb"}, "empty.glb");
  write(dir / "cut.glb", std::string("glTF\2\0\0\0\xff\xff\xff\xff", 12));
  expect_failure({"scene", "info", dir / "cut.glb"}, "cut.glb");
  write(dir / "index.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":7}]})");
  expect_failure({"scene", "info", dir / "index.gltf"}, "nodes");
  write(dir / "nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  expect_failure({"scene", "info", dir / "nan.obj"}, "nan.obj");
  write(dir / "text.xyz", "hello");
  expect_failure({"scene", "info", dir / "text.xyz"}, "text.xyz");
}

TEST(BadInput, WarningsDoNotStopTheWork) {
  const TempDir dir;
  write(dir / "plain.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 2 4\n");
  const ToolResult no_lights = run_tool(joined({"render", dir / "plain.obj", "-o", dir / "x.exr"}, small));
  EXPECT_EQ(no_lights.exit_code, 0) << no_lights.err;
  EXPECT_THAT(no_lights.err, AllOf(HasSubstr("warning"), HasSubstr("no lights"), HasSubstr("gone.mtl"),
                                   HasSubstr("--sky or --environment FILE")));
}

TEST(BadInput, ASceneWithoutLightsStandsInAStudioUnlessItIsMeantToBeDark) {
  const TempDir dir;
  write(dir / "plain.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
  write(dir / "off.json",
        R"({"lights": [{"name": "lamp", "type": "point", "position": [0, 0, 2], "intensity": 0}]})");
  const std::vector<std::string> render = joined({"render", dir / "plain.obj", "-o", dir / "x.exr"}, small);
  const json::Value mean = test::run_json(render)["mean"];
  EXPECT_GT(mean[0].number(), 0.1);
  EXPECT_EQ(mean[0], mean[2]) << "neutral";
  const ToolResult off = run_tool(
      joined({"render", dir / "plain.obj", "--overlay", dir / "off.json", "-o", dir / "x.exr"}, small));
  EXPECT_THAT(off.out, HasSubstr("mean radiance 0 0 0"));
  EXPECT_THAT(off.err, Not(HasSubstr("studio")));
  EXPECT_THAT(run_tool({"scene", "info", dir / "plain.obj"}).out, HasSubstr("no environment"))
      << "as the file is";
}

TEST(BadInput, AProbeInsideABodyIsWarnedAbout) {
  const TempDir dir;
  write(dir / "inside.json", R"({"sphls": [{"name": "buried", "position": [0.33, 0.2, 0.3]}]})");
  const ToolResult result =
      run_tool({"bake", "builtin:cornell", "--overlay", dir / "inside.json", "-o", dir / "x.sphl", "--face",
                "8", "--spp", "1", "--viz", "off", "--records", "0"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("warning"), HasSubstr("buried"), HasSubstr("inside a body")));
}

TEST(BadInput, BakeWithoutProbesSaysHowToAddThem) {
  const TempDir dir;
  write(dir / "plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_failure({"bake", dir / "plain.obj", "-o", dir / "x.sphl", "--probes", "scene"}, "--probes auto");
}

TEST(BadInput, SsphhOnAFarmWithoutProbesSaysHowToBake) {
  const TempDir dir;
  expect_failure(
      joined({"render", "builtin:box", "--method", "ssphh", "--local", "1", "-o", dir / "x.exr"}, small),
      "ssphh bake");
}

TEST(BadInput, BrokenProbeFilesAndImages) {
  const TempDir dir;
  write(dir / "a.sphl", "not a probe file");
  write(dir / "a.sphl.json", R"({"version": 99})");
  write(dir / "a.exr", "v/1\1");
  write(dir / "a.hdr", "#?RADIANCE\n");
  write(dir / "a.json", R"({"degree": 2, "coefficients": [[1,2,3]]})");
  expect_failure({"probe", "info", dir / "a.sphl"}, "a.sphl");
  expect_failure({"probe", "info", dir / "a.sphl.json"}, "version");
  expect_failure({"sh", "project", dir / "a.exr", "--layout", "equirect", "--degree", "2"}, "a.exr");
  expect_failure({"compare", dir / "a.hdr", dir / "a.hdr"}, "a.hdr");
  expect_failure({"sh", "irradiance", dir / "a.json", "--normal", "0", "0", "1"}, "a.json");
}

TEST(BadInput, UnwritableOutputAndFullDisk) {
  const TempDir dir;
  expect_failure(joined({"render", "builtin:box", "-o", dir / "no/such/folder/x.exr"}, small), "folder");
  std::filesystem::create_symlink("/dev/full", dir / "full.exr");
  expect_failure(joined({"render", "builtin:box", "-o", dir / "full.exr"}, small), "No space left on device");
  std::filesystem::create_symlink("/dev/full", dir / "full.sphl");
  expect_failure({"bake", "builtin:box", "-o", dir / "full.sphl", "--face", "4", "--spp", "1", "--viz", "off",
                  "--records", "0"},
                 "No space left on device");
}

TEST(BadInput, CtrlCLeavesTheOldOutputAndResumeGivesTheSameBits) {
  const TempDir dir;
  const std::string cut = dir / "cut.exr", whole = dir / "whole.exr";
  const std::vector<std::string> effort = {"--width", "64", "--height", "64", "--spp", "4", "--passes", "60"};
  write(cut, "the old file");
  ToolProcess process(joined({"render", "builtin:cornell", "-o", cut, "--progress", "json"}, effort));
  ASSERT_TRUE(process.wait_for_stderr("\"done\"")) << process.stderr_so_far();
  process.signal(SIGINT);
  const ToolResult stopped = process.wait();
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_THAT(stopped.err, HasSubstr("cancelled"));
  EXPECT_EQ(read(cut), "the old file");

  ASSERT_EQ(run_tool(joined({"render", "builtin:cornell", "-o", cut, "--resume"}, effort)).exit_code, 0);
  ASSERT_EQ(run_tool(joined({"render", "builtin:cornell", "-o", whole, "--threads", "1"}, effort)).exit_code,
            0);
  EXPECT_TRUE(read(cut) == read(whole));
}

TEST(BadInput, AKilledBakeResumesToTheSameBits) {
  const TempDir dir;
  const std::string cut = dir / "cut.sphl", whole = dir / "whole.sphl";
  const std::vector<std::string> effort = {"--face",      "16", "--spp",    "64",
                                           "--max-depth", "8",  "--degree", "3"};
  ToolProcess process(joined({"bake", "builtin:cornell", "-o", cut, "--progress", "json"}, effort));
  ASSERT_TRUE(process.wait_for_stderr("\"done\"")) << process.stderr_so_far();
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait().exit_code, 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(cut));

  ASSERT_EQ(run_tool(joined({"bake", "builtin:cornell", "-o", cut}, effort)).exit_code, 0);
  ASSERT_EQ(run_tool(joined({"bake", "builtin:cornell", "-o", whole}, effort)).exit_code, 0);
  EXPECT_TRUE(read(cut) == read(whole));
}

}  // namespace
}  // namespace ssphh
