// `ssphh report`: plans run, kept, continued, and what failed shown.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "places.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

namespace fs = std::filesystem;
using test::expect_failure;
using test::expect_keys;
using test::run_json;
using test::TempDir;
using testing::HasSubstr;

const std::string tiny_plan = test::source_dir() / "plans/tiny.json";

std::string slurp(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_json(const fs::path& path, const json::Value& object) {
  std::ofstream(path) << print(object);
}

json::Value plan_of(std::vector<json::Value> methods) {
  return {{"scenes", {{{"name", "box"}, {"scene", "builtin:box"}}}}, {"methods", std::move(methods)}};
}

json::Value method(const std::string& name, const std::string& step) {
  return {{"name", name}, {"steps", {step}}, {"picture", "o.exr"}};
}

const json::Value& cell(const json::Value& report, const std::string& label) {
  static const json::Value none;
  for (const json::Value& c : report["cells"].elements()) {
    if (c["label"] == label) return c;
  }
  ADD_FAILURE() << "no cell " << label;
  return none;
}

TEST(Report, RunsAPlanOnceAndAgainOnlyWhatChanged) {
  const TempDir dir;
  const std::string out = dir / "out/tiny";
  const json::Value first = run_json({"report", tiny_plan, "-o", out});
  expect_keys(first, {"output", "commands", "run", "cached", "cells", "failed", "notes", "page_bytes"});
  EXPECT_EQ(first["failed"], 0);
  EXPECT_EQ(first["cells"], 4);  // truth, path at two depths, ssphh
  EXPECT_EQ(first["run"], 9);    // 1 + 2·3 + 2
  ASSERT_EQ(first["notes"].size(), 1u);
  EXPECT_THAT(first["notes"][0].string(), HasSubstr("no-such-scene.glb"));

  const json::Value report = test::parse_json(slurp(out + "/report.json"));
  const json::Value& path = cell(report, "path, depth 4")["values"];
  EXPECT_EQ(path["relmse"]["count"], 3);
  EXPECT_GT(path["noise"]["mean"].number(), 0);
  EXPECT_GT(cell(report, "path, depth 1")["values"]["relmse_bias"]["mean"].number(),
            path["relmse_bias"]["mean"].number())
      << "without indirect light the picture is biased";
  EXPECT_GT(cell(report, "ssphh")["values"]["bake.file_bytes"]["mean"].number(), 100);
  EXPECT_THAT(cell(report, "ssphh")["steps"][1]["command"].string(),
              HasSubstr("render builtin:two-rooms --time 1"));
  EXPECT_THAT(report["provenance"]["created"].string(),
              testing::MatchesRegex("20[0-9][0-9]-[01][0-9]-[0-3][0-9] [0-2][0-9]:[0-5][0-9] UTC"));
  EXPECT_EQ(report["scenes"][0]["hash"], run_json({"scene", "info", "builtin:two-rooms"})["hash"]);
  const std::string page = slurp(out + "/report.html");
  EXPECT_EQ(page.substr(0, 2), "\xff\xfe");  // UTF-16
  EXPECT_EQ(page.size(), first["page_bytes"]);

  EXPECT_EQ(run_json({"report", tiny_plan, "-o", out})["changed"], false);
  fs::remove(out + "/report.md");
  const json::Value again = run_json({"report", tiny_plan, "-o", out});
  EXPECT_EQ(again["run"], 0);
  EXPECT_EQ(again["cached"], 9);
  const json::Value finer = run_json({"report", tiny_plan, "-o", out, "--set", "spp=3"});
  EXPECT_EQ(finer["run"], 7);  // not the truth, not the bake
  fs::remove_all(dir / "out/cache");
  EXPECT_EQ(run_json({"report", tiny_plan, "-o", dir / "out/other"})["run"], 9);
}

TEST(Report, AFailureIsACellWithItsLogAndIsTriedAgain) {
  const TempDir dir;
  json::Value plan =
      plan_of({method("good", "render {scene} --width 8 --height 8 --spp 1 -o o.exr"),
               method("bad", "render {scene} --camera nowhere --width 8 --height 8 -o o.exr"),
               method("slow", "render {scene} --width 2000 --height 2000 --spp 60000 -o o.exr")});
  plan["methods"].push_back(
      {{"name", "after bad"},
       {"steps", {"bake {scene} --probes nonsense -o p.sphl", "hier p.sphl -o h.sphl"}}});
  plan["time_limit"] = 1;
  write_json(dir / "plan.json", plan);
  const json::Value result = run_json({"report", dir / "plan.json", "-o", dir / "out"}, 1);
  EXPECT_EQ(result["failed"], 3);
  const json::Value report = test::parse_json(slurp(dir / "out/report.json"));
  EXPECT_TRUE(cell(report, "good")["failure"].is_null());
  EXPECT_THAT(cell(report, "bad")["failure"].string(), HasSubstr("nowhere"));
  EXPECT_THAT(cell(report, "slow")["failure"].string(), HasSubstr("not done after 1 s"));
  EXPECT_THAT(cell(report, "after bad")["failure"].string(), HasSubstr("nonsense"));
  EXPECT_THAT(slurp(dir / "out/report.md"), HasSubstr("Failed: box, slow"));

  json::Array methods = plan["methods"].elements();
  methods.erase(methods.begin() + 2);
  plan["methods"] = methods;
  write_json(dir / "plan.json", plan);
  const json::Value again = run_json({"report", dir / "plan.json", "-o", dir / "out"}, 1);
  EXPECT_EQ(again["cached"], 1);
  EXPECT_EQ(again["failed"], 2);
}

TEST(Report, AnInterruptedOneContinues) {
  const TempDir dir;
  write_json(dir / "plan.json",
             plan_of({method("quick", "render {scene} --width 8 --height 8 --spp 1 -o o.exr"),
                      method("long", "render {scene} --width 2000 --height 2000 --spp 60000 -o o.exr")}));
  {
    const std::vector<std::string> words = {"report",    dir / "plan.json", "-o",
                                            dir / "out", "--cache",         dir / "cache"};
    test::ToolProcess running(words);
    const auto finished = [&] {  // the quick run's folder, and the long one's unfinished
      int whole = 0, part = 0;
      if (fs::is_directory(dir / "cache")) {
        for (const auto& entry : fs::directory_iterator(dir / "cache"))
          ++(entry.path().extension() == ".part" ? part : whole);
      }
      return whole == 1 && part == 1;
    };
    for (int i = 0; i < 3000 && !finished(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    running.signal(SIGINT);
    EXPECT_EQ(running.wait().exit_code, 1);
  }
  EXPECT_FALSE(fs::exists(dir / "out/report.json"));
  for (const auto& entry : fs::directory_iterator(dir / "cache"))
    EXPECT_NE(entry.path().extension(), ".part") << "nothing half-done stays";
  write_json(dir / "plan.json",
             plan_of({method("quick", "render {scene} --width 8 --height 8 --spp 1 -o o.exr"),
                      method("short", "render {scene} --width 8 --height 8 --spp 2 -o o.exr")}));
  const json::Value result =
      run_json({"report", dir / "plan.json", "-o", dir / "out", "--cache", dir / "cache"});
  EXPECT_EQ(result["cached"], 1);
  EXPECT_EQ(result["run"], 1);
}

TEST(Report, PicturesOfDifferentSizesAreAFailedCell) {
  const TempDir dir;
  json::Value plan = plan_of({method("small", "render {scene} --width 8 --height 8 --spp 1 -o o.exr")});
  plan["reference"] = {{"steps", {"render {scene} --width 16 --height 8 --spp 1 -o t.exr"}},
                       {"picture", "t.exr"}};
  write_json(dir / "plan.json", plan);
  EXPECT_EQ(run_json({"report", dir / "plan.json", "-o", dir / "out"}, 1)["failed"], 1);
}

TEST(Report, MistakesInThePlanAreNamed) {
  const TempDir dir;
  json::Value plan = plan_of({method("m", "render {scene} -o o.exr")});
  plan["colums"] = json::Value::array();
  write_json(dir / "key.json", plan);
  expect_failure({"report", dir / "key.json", "-o", dir / "out"},
                 {"unknown member \"colums\"", "\"columns\""});
  plan = plan_of({method("m", "report {scene} -o o.exr")});
  write_json(dir / "self.json", plan);
  expect_failure({"report", dir / "self.json", "-o", dir / "out"}, "unknown command \"report\"");
  plan = plan_of({method("m", "render {scene} -o o.exr")});
  plan["scenes"][0]["scene"] = "builtin:box --tiem 1";
  write_json(dir / "scene.json", plan);
  expect_failure({"report", dir / "scene.json", "-o", dir / "out"}, "scene box");
  expect_failure({"report", tiny_plan, "-o", dir / "out", "--set", "sp=1"},
                 {"no variable \"sp\"", "\"spp\""});
  std::ofstream(dir / "broken.json") << "{";
  expect_failure({"report", dir / "broken.json", "-o", dir / "out"}, "is not valid JSON");
  expect_failure({"report", dir / "absent.json", "-o", dir / "out"}, "absent.json", 2);
  EXPECT_FALSE(fs::exists(dir / "out"));
}

}  // namespace
}  // namespace ssphh
