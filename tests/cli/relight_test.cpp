// `ssphh relight` and `ssphh leak`: keys that scripts rely on, and what they say to bad input.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "here.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::expect_failure;
using test::expect_keys;
using test::run_json;
using test::run_tool;
using test::TempDir;
using test::ToolProcess;
using test::ToolResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> relight(const std::vector<std::string>& more) {
  return test::joined({"relight", "builtin:two-rooms", "--surfel-size", "0.8", "--link-rays", "32"}, more);
}

TEST(Relight, BounceFollowsLampsAndDoorsToo) {
  const TempDir dir;
  const std::string saved = dir / "last.sphl";
  const json::Value run = run_json(relight({"--operator", "bounce", "--frames", "3", "--truth", "2",
                                            "--points", "16", "--truth-spp", "16", "--save", saved}));
  EXPECT_EQ(run["operator"], "bounce");
  EXPECT_GT(run["stages"]["solve"]["iterations"].number(), 1);
  EXPECT_GT(run["stages"]["pose"]["rays"].number(), 0);
  EXPECT_EQ(run["error"].size(), 2u);
  EXPECT_EQ(run_json({"probe", "info", saved})["generator"]["operator"], "bounce");
  expect_failure(relight({"--operator", "bounce", "--poses", "4"}), "--poses");
}

TEST(Relight, ReportsStagesRaysAndErrors) {
  const TempDir dir;
  const std::string frames = dir / "frames", saved = dir / "last.sphl";
  const json::Value run = run_json(relight({"--animate", "time=0:1", "--animate",   "lamp.intensity=4:0",
                                            "--frames",  "4",        "--truth",     "3",
                                            "--points",  "32",       "--truth-spp", "32",
                                            "-o",        frames,     "--pictures",  "3",
                                            "--width",   "16",       "--height",    "9",
                                            "--spp",     "1",        "--save",      saved}));
  expect_keys(run, {"frames", "median_ms", "p99_ms", "stages", "error", "rays_per_frame", "build_ms",
                    "first_ms", "probes", "surfels", "cancelled"});
  EXPECT_EQ(run["frames"], 4);
  EXPECT_EQ(run["probes"], 6);
  EXPECT_FALSE(run["cancelled"].boolean());
  for (const char* stage : {"pose", "direct", "solve", "project"})
    expect_keys(run["stages"][stage], {"median_ms", "p99_ms"});
  EXPECT_GT(run["stages"]["pose"]["rays"].number(), 0) << "the door";
  ASSERT_EQ(run["error"].size(), 2u);
  expect_keys(run["error"][0], {"frame", "seconds", "ratio", "mean_relative", "noise", "relmse"});
  EXPECT_EQ(run["error"][1]["frame"], 3);
  EXPECT_TRUE(run["error"][1]["worst"]["ratio"].is_null())
      << "the lamp is off: there is no truth to divide by";
  EXPECT_NEAR(run["error"][0]["worst"]["ratio"].number(), 1, 0.5);
  for (const char* file : {"frame-0000.png", "frame-0003.png", "error.svg"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(frames) / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(frames) / "frame-0001.png"));
  EXPECT_LT(std::abs(run["exposure"].number()), 8) << "of the first frame, not of the dark last one";
  EXPECT_EQ(run_json({"probe", "info", saved})["probes"].size(), 6u);
}

TEST(Relight, TakesThePlacesOfAProbeFileAndSavesWhatLeakReads) {
  const TempDir dir;
  const std::string shut = dir / "shut.sphl", again = dir / "again.sphl", map = dir / "map.png";
  run_json(relight({"--probes", "auto:2", "--animate", "lamp.scale=1", "--frames", "1", "--save", shut}));
  const ToolResult result = run_tool(
      relight({"--probes", shut, "--animate", "lamp.scale=1", "--frames", "1", "--save", again, "--json"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, Not(HasSubstr("warning")));
  EXPECT_EQ(run_json({"probe", "info", again})["probes"], run_json({"probe", "info", shut})["probes"]);

  const json::Value leak =
      run_json({"leak", "builtin:two-rooms", "--probes", shut, "--points", "64", "--truth-spp", "16", "-o",
                map, "--width", "16", "--height", "9", "--map-spp", "4"});
  expect_keys(leak, {"leak_ratio", "points", "dark_points", "truth_noise", "map"});
  EXPECT_EQ(leak["points"], 64);
  EXPECT_LE(leak["leak_ratio"].number(), 1e-5) << "the door is shut";
  EXPECT_GT(leak["dark_points"].number(), 10);
  EXPECT_TRUE(std::filesystem::exists(map));

  // Both files against one truth, each with two ways of blending.
  const json::Value all =
      run_json({"measure", "builtin:two-rooms", "--probes", shut, again, "--weights", "distance,mls",
                "--points", "64", "--truth-spp", "16", "--box", "-9,-9,-9,0,9,9"});
  expect_keys(all, {"points", "dark_points", "mean_truth", "noise", "results"});
  EXPECT_EQ(all["points"], 64) << "all of them in room A";
  ASSERT_EQ(all["results"].size(), 4u);
  for (const json::Value& one : all["results"].elements()) {
    expect_keys(one, {"probes", "weights", "ratio", "mean_error", "mean_relative", "median_relative",
                      "p95_relative", "relmse", "leak_ratio"});
    for (const json::Value& ratio : one["ratio"].elements()) EXPECT_NEAR(ratio.number(), 1, 0.3);
  }
  EXPECT_EQ(all["results"][0]["ratio"], all["results"][2]["ratio"]) << "the same light";
  EXPECT_NE(all["results"][0]["ratio"], all["results"][1]["ratio"]);
  expect_failure({"measure", "builtin:two-rooms", "--probes", shut, "--weights", "fitted"}, {"--fit"});
  expect_failure({"measure", "builtin:two-rooms", "--probes", shut, "--box", "50,50,50,51,51,51"},
                 {"box: it lies outside of the scene"});
  expect_failure({"measure", "builtin:two-rooms", "--probes", shut, "--time", "1"}, {"time 0 s, now 1 s"});
}

TEST(Relight, SaysWhatCannotBeAnimated) {
  expect_failure(relight({"--animate", "lmp.intensity=0:4"}), {"lmp", "its lights: lamp"});
  expect_failure(relight({"--animate", "lmp.scale=0:4"}), {"lmp", "its groups: lamp"});
  expect_failure(relight({"--animate", "lamp.size=0:4"}), {"lamp.size", "LIGHT.intensity"});
  expect_failure(relight({"--animate", "lamp.intensity"}), {"no '='"});
  expect_failure(relight({"--animate", "lamp.intensity=0:x"}), {"\"x\" is not a number"});
  expect_failure(relight({"--animate", "lamp.intensity=0:nan"}), {"\"nan\" is not a number"});
  expect_failure(relight({"--animate", "lamp.intensity=-1"}), {"negative"});
  expect_failure(relight({"--animate", "lamp.position=1,2"}), {"three numbers"});
  expect_failure(relight({"--animate", "lamp.direction=0,-1,0"}), {"position"});
  expect_failure(relight({"--animate", "time=0:1", "--animate", "time=1:0"}), {"twice"});
  expect_failure(relight({"--animate", "environment.rotation=0:90"}),
                 {"--animate \"environment.rotation=0:90\": the scene has no environment"});
  expect_failure({"relight", "builtin:cornell"}, {"nothing moves"});
}

TEST(Relight, RefusesWrongUsageAndBrokenFiles) {
  const TempDir dir;
  expect_failure(relight({"--frames", "0"}), {"--frames"}, 2);
  expect_failure(relight({"--frames", "-5"}), {"--frames"}, 2);
  expect_failure(relight({"--probes", "nonsense"}), {"nonsense"}, 2);
  expect_failure(relight({"--probes", dir / "none.sphl"}), {"none.sphl"});
  expect_failure(relight({"-o", dir / "x", "--camera", "nobody"}), {"room-a"});

  const std::string file = dir / "p.sphl.json";
  run_json(relight({"--animate", "lamp.scale=1", "--frames", "1", "--save", file}));
  json::Value probes = test::parse_json(read_text_file(file));
  probes["probes"][2]["position"][0] = "nan";
  std::ofstream(file) << print(probes);
  expect_failure(relight({"--probes", file}), {"p.sphl.json", "probes[2].position"});
  expect_failure({"leak", "builtin:two-rooms", "--probes", file}, {"p.sphl.json", "probes[2].position"});
  expect_failure({"leak", "builtin:two-rooms", "--probes", dir / "x.exr"}, {".sphl"}, 2);
}

TEST(Relight, WarnsOfProbesThatCannotLight) {
  const TempDir dir;
  const std::string overlay = dir / "o.json", saved = dir / "s.sphl";
  std::ofstream(overlay) << R"({"sphls": [{"name": "swept", "position": [0.4, 1, -0.1]},
                                          {"name": "outside", "position": [0, 50, 0]}]})";
  const ToolResult moving =
      run_tool(relight({"--overlay", overlay, "--animate", "time=0:1", "--frames", "2", "--save", saved}));
  EXPECT_EQ(moving.exit_code, 0) << moving.err;
  EXPECT_THAT(moving.err, AllOf(HasSubstr("\"swept\" stands in the way of \"door\"")));
  const ToolResult still =
      run_tool(relight({"--overlay", overlay, "--animate", "lamp.scale=0:1", "--frames", "2"}));
  EXPECT_THAT(still.err, Not(HasSubstr("in the way")));
  // Another scene than the file was made in: the overlay's SPHLs do not count, a lamp does.
  std::ofstream(overlay) << R"({"lights": [{"name": "l", "type": "point", "position": [1, 1, 1]}]})";
  const ToolResult other = run_tool(relight({"--overlay", overlay, "--probes", saved, "--frames", "1"}));
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, AllOf(HasSubstr("light groups: 1 (lamp), now 2 (lamp, l)"), HasSubstr("--force")));
  EXPECT_EQ(
      run_tool(relight({"--overlay", overlay, "--probes", saved, "--frames", "1", "--force"})).exit_code, 0);

  std::ofstream(dir / "two.obj") << "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
  std::ofstream(dir / "two.ssphh.json")
      << R"({"scene": "two.obj", "lights": [{"name": "l", "type": "point", "position": [0.2, 1, 0.2]}],
             "sphls": [{"name": "near", "position": [0.2, 0.3, 0.2]}, {"name": "lost", "position": [0, 1e4, 0]}]})";
  const ToolResult flat = run_tool({"relight", dir / "two.ssphh.json", "--animate", "l.intensity=0:1"});
  EXPECT_EQ(flat.exit_code, 0) << flat.err;
  EXPECT_THAT(flat.err, AllOf(HasSubstr("\"lost\" sees no surface"), HasSubstr("no surface sees another"),
                              Not(HasSubstr("\"near\" sees"))));
}

TEST(Relight, CtrlCReportsTheFramesThatWereDone) {
  ToolProcess process(relight({"--frames", "1000000", "--progress", "json", "--json"}));
  ASSERT_TRUE(process.wait_for_stderr("\"relighting\"")) << process.stderr_so_far();
  process.signal(SIGINT);
  const ToolResult stopped = process.wait();
  EXPECT_EQ(stopped.exit_code, 1);
  const json::Value run = test::parse_json_if_any(stopped.out);
  ASSERT_TRUE(run.is_object()) << stopped.out;
  EXPECT_TRUE(run["cancelled"].boolean());
  EXPECT_GT(run["frames"].number(), 0);
  EXPECT_LT(run["frames"].number(), 1000000);
}

}  // namespace
}  // namespace ssphh
