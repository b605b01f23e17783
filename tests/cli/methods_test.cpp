// `ssphh methods`, `render --method`, `measure --method` and `respond`: keys that scripts rely on, and what
// they say to bad input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::expect_failure;
using test::expect_keys;
using test::run_json;
using test::TempDir;

TEST(Methods, ListNamesParameters) {
  const json::Value all = run_json({"methods"})["methods"];
  EXPECT_GE(all.size(), 3u);
  const json::Value one = run_json({"methods", "ssphh"})["methods"];
  ASSERT_EQ(one.size(), 1u);
  expect_keys(one[0], {"name", "about", "parameters"});
  expect_keys(one[0]["parameters"][0], {"name", "default", "about", "choices"});
  expect_failure({"methods", "shph"}, {"ssphh"});
}

TEST(Methods, RenderReportsWhatTheMethodTook) {
  const TempDir dir;
  const std::string picture = dir / "a.exr";
  const json::Value run =
      run_json({"render", "builtin:box", "--method", "ssphh", "--param", "probes=8", "--param", "weights=mls",
                "--width", "8", "--height", "8", "--spp", "1", "-o", picture});
  expect_keys(run, {"mean", "bake_seconds", "update_seconds", "lookup_bytes", "update_bytes", "probes"});
  EXPECT_EQ(run["probes"], 8);
  const std::vector<std::string> base = {"render", "builtin:box", "-o", picture, "--method"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return more;
  };
  expect_failure(with({"ambient", "--param", "factr=2"}), {"factor"});
  expect_failure(with({"path", "--param", "factor=2"}), {"--param"});
  expect_failure(with({"ambient", "--probes", "x.sphl"}), {"--probes", "ambient"});
  expect_failure(with({"ambient", "--local", "1"}), {"ambient"});
}

TEST(Methods, MeasureComparesThem) {
  const json::Value run = run_json({"measure", "builtin:box", "--method", "direct", "--method",
                                    "ssphh,probes=8,weights=mls", "--points", "32", "--truth-spp", "32"});
  ASSERT_EQ(run["results"].size(), 2u);
  expect_keys(run["results"][1], {"method", "ratio", "mean_error", "relmse", "leak_ratio", "lookup_us",
                                  "bake_seconds", "update_seconds", "lookup_bytes"});
  EXPECT_EQ(run["results"][0]["ratio"], json::Value({0, 0, 0}));
  EXPECT_NEAR(run["results"][1]["worst"]["ratio"].number(), 1, 0.3);
  expect_failure({"measure", "builtin:box"}, {"--method"});
  expect_failure({"measure", "builtin:box", "--method", "radiosity"}, {"radiosity"});
}

TEST(Respond, TellsHowFastAMethodFollows) {
  const TempDir dir;
  const std::string csv = dir / "frames.csv";
  const json::Value run = run_json({"respond",     "builtin:two-rooms",
                                    "--method",    "ssphh",
                                    "--param",     "places=scene",
                                    "--param",     "weights=mls",
                                    "--param",     "surfel_size=0.8",
                                    "--frames",    "3",
                                    "--points",    "32",
                                    "--truth-spp", "64",
                                    "--event",     "lamp.scale=0.1:1",
                                    "-o",          csv});
  expect_keys(run, {"before_error", "first_error", "last_error", "frames_to_settle", "median_ms", "frames"});
  EXPECT_EQ(run["frames"].size(), 3u);
  EXPECT_EQ(run["frames_to_settle"], 1);
  EXPECT_LT(run["first_error"].number(), run["before_error"].number());
  const std::string text = read_text_file(csv);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
  expect_failure({"respond", "builtin:two-rooms", "--event", "time=1:1"},
                 {"--event: nothing changes (give two different keys, as in time=0:1)"});
  expect_failure({"respond", "builtin:two-rooms", "--event", "lamp.pos=1:2"}, {"lamp"});
}

TEST(Methods, DefaultsLightAStreetWhateverItsUnit) {
  // Houses 2 mm high on a plain a hundred times as wide: once 1.6 times too bright
  const json::Value found = run_json({"measure", "builtin:random?seed=4", "--method", "ssphh,records=3000",
                                      "--views", "--points", "32", "--truth-spp", "256"});
  for (const char* view : {"view street", "view middle"}) {
    const json::Value errors = found["results"][0]["regions"][view];
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(errors["ratio"][c].number(), 1, 0.08) << view << ", channel " << c;
      EXPECT_LT(errors["mean_error"][c].number(), 0.2) << view << ", channel " << c;
    }
  }
}

}  // namespace
}  // namespace ssphh
