// Placement and lint as a user types them.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "here.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::joined;
using test::run_json;
using test::run_tool;
using test::TempDir;
using test::ToolResult;
using testing::HasSubstr;

const std::vector<std::string> quick = {"--degree", "1", "--face", "4", "--spp", "1"};

TEST(PlaceTool, BakeTakesTheScenesProbesUnlessAsked) {
  const TempDir dir;
  const json::Value bake =
      run_json(joined({"bake", "builtin:two-rooms", "-o", dir / "a.sphl", "--records", "0"}, quick));
  EXPECT_EQ(bake["probes"], 6);
  EXPECT_FALSE(bake.contains("placement"));
  EXPECT_EQ(bake["viz"], "path");
}

TEST(PlaceTool, ANumberOfProbesKeepsTheScenesOwn) {
  const TempDir dir;
  const json::Value bake = run_json(joined(
      {"bake", "builtin:two-rooms", "-o", dir / "a.sphl", "--probes", "20", "--viz", "off", "--records", "0"},
      quick));
  EXPECT_EQ(bake["probes"], 20);
  EXPECT_EQ(bake["placement"]["manual"], 6);
  for (const char* key : {"probes", "spacing", "removed", "relocated", "edges", "seconds"})
    EXPECT_TRUE(bake["placement"].contains(key)) << key;
  const json::Value info = run_json({"probe", "info", dir / "a.sphl"});
  EXPECT_EQ(info["probes"][0]["name"], "A west");
}

TEST(PlaceTool, ManyProbesGetTheirEdgesFromLinks) {
  const TempDir dir;
  const json::Value bake =
      run_json(joined({"bake", "builtin:two-rooms", "-o", dir / "a.sphl", "--probes", "auto:1",
                       "--directions", "64", "--link-rays", "16", "--surfel-size", "0.5", "--records", "0"},
                      quick));
  EXPECT_GT(bake["probes"].number(), 64);
  EXPECT_EQ(bake["viz"], "links");
  EXPECT_GT(bake["edges"].number(), bake["probes"].number());
}

TEST(PlaceTool, WhatPlaceWritesIsAScene) {
  const TempDir dir;
  const std::string overlay = dir / "placed.ssphh.json";
  const json::Value place = run_json({"place", "builtin:two-rooms", "--probes", "auto:1.5", "-o", overlay});
  for (const char* key : {"probes", "spacing", "removed", "relocated", "edges", "seconds"})
    EXPECT_TRUE(place.contains(key)) << key;
  const json::Value info = run_json({"scene", "info", overlay});
  EXPECT_EQ(info["sphls"], place["probes"]);
  // Places found once more beside them: all are taken.
  const json::Value again =
      run_json({"place", overlay, "--probes", "auto:1.5", "-o", dir / "again.ssphh.json"});
  EXPECT_EQ(again["manual"], place["probes"]);
  EXPECT_LE(test::count_of(again["probes"]), test::count_of(place["probes"]) + 8);
}

// The places are in metres: without its unit the scene would be another.
TEST(PlaceTool, WhatPlaceWritesKeepsTheUnit) {
  const TempDir dir;
  const std::string overlay = dir / "placed.ssphh.json";
  const json::Value place =
      run_json({"place", "builtin:two-rooms", "--unit", "2", "--probes", "auto:3", "-o", overlay});
  const json::Value twice = run_json({"scene", "info", "builtin:two-rooms", "--unit", "2"});
  EXPECT_EQ(run_json({"scene", "info", overlay})["bounds"], twice["bounds"]);
  EXPECT_NE(run_json({"scene", "info", "builtin:two-rooms"})["bounds"], twice["bounds"]);
  EXPECT_GT(place["probes"].number(), 0);
}

TEST(PlaceTool, SaysWhatIsWrong) {
  const TempDir dir;
  const auto bake = [&](const std::string& probes, const std::vector<std::string>& more = {}) {
    return run_tool(joined({"bake", "builtin:two-rooms", "-o", dir / "a.sphl", "--probes", probes}, more));
  };
  for (const char* bad :
       {"auto:0", "auto:-1", "auto:nan", "auto:inf", "auto:", "auto:1m", "0", "-3", "some"}) {
    const ToolResult result = bake(bad);
    EXPECT_EQ(result.exit_code, 2) << bad;
    EXPECT_THAT(result.err, HasSubstr("--probes")) << bad;
  }
  const ToolResult many = bake("auto:0.001");
  EXPECT_EQ(many.exit_code, 1);
  EXPECT_THAT(many.err, HasSubstr("more than 65536 probes"));
  const ToolResult few = bake("auto:1", {"--max-probes", "10"});
  EXPECT_EQ(few.exit_code, 1);
  EXPECT_THAT(few.err, HasSubstr("more than 10 probes"));
  EXPECT_EQ(run_tool({"place", "builtin:two-rooms", "-o", dir / "a.json"}).exit_code, 2);
}

TEST(LintTool, ExitCodeIsAGate) {
  const TempDir dir;
  const std::string file = dir / "a.sphl.json";
  run_json({"bake", "builtin:cornell", "-o", file, "--viz", "off", "--face", "8", "--spp", "16", "--records",
            "0"});
  const json::Value clean = run_json({"probe", "lint", file, "--scene", "builtin:cornell"});
  EXPECT_EQ(clean["probes"], 5);
  EXPECT_THAT(clean["problems"], testing::IsEmpty());

  // Put one into the tall box.
  json::Value set = test::parse_json(read_text_file(file));
  set["probes"][1]["position"] = {-0.335, 0.5, -0.29};
  std::ofstream(file) << print(set);
  const json::Value broken = run_json({"probe", "lint", file, "--scene", "builtin:cornell"}, 1);
  ASSERT_FALSE(broken["problems"].empty());
  const json::Value& problem = broken["problems"][0];
  EXPECT_EQ(problem["kind"], "inside");
  EXPECT_EQ(problem["probe"], set["probes"][1]["name"]);
  EXPECT_NEAR(problem["position"][1].number(), 0.5, 1e-6);
  EXPECT_THAT(problem["message"].string(), HasSubstr("inside"));
  EXPECT_EQ(run_tool({"probe", "lint", file}).exit_code, 2) << "--scene is missing";
}

}  // namespace
}  // namespace ssphh
