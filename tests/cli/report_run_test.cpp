// How `ssphh report` runs the command lines of a plan, with a script in place of the tool.

#include "commands/report_run.h"

#include <fstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/report/expansion.h>

#include "temp_dir.h"

namespace ssphh::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(RunsOnFarm, PathTracedBakesRendersAndTruthsDo) {
  const auto runs = [](const std::vector<std::string>& words) { return runs_on_farm(words); };
  EXPECT_TRUE(runs({"bake", "builtin:box"}));
  EXPECT_TRUE(runs({"bake", "builtin:box", "--operator", "path"}));
  EXPECT_FALSE(runs({"bake", "builtin:box", "--operator", "surfel"}));
  EXPECT_TRUE(runs({"truth", "builtin:box"}));
  EXPECT_TRUE(runs({"truth", "builtin:box", "--renderer", "path"}));
  EXPECT_FALSE(runs({"truth", "builtin:box", "--renderer", "cycles"}));
  EXPECT_TRUE(runs({"render", "builtin:box"}));
  EXPECT_TRUE(runs({"render", "builtin:box", "--method", "path", "--backend", "cpu"}));
  EXPECT_TRUE(runs({"render", "builtin:box", "--method", "ssphh", "--probes", "a.sphl"}));
  EXPECT_FALSE(runs({"render", "builtin:box", "--method", "ssphh"})) << "probes made for one picture";
  EXPECT_FALSE(runs({"render", "builtin:box", "--method", "vpl"}));
  EXPECT_FALSE(runs({"render", "builtin:box", "--method", "vpl", "--probes", "a.sphl"}));
  EXPECT_FALSE(runs({"render", "builtin:box", "--method", "ssphh", "--probes", "a.sphl", "--backend", "gl"}));
  EXPECT_FALSE(runs({"render", "builtin:box", "--resume"}));
  EXPECT_FALSE(runs({"measure", "builtin:box"}));
  EXPECT_TRUE(runs({"render", "builtin:box", "--method"})) << "an option without its value is none";
}

/// A plan of commands for a shell script that notes how it was called.
class ReportRun : public testing::Test {
 protected:
  ReportRun() {
    place_.tool = dir_ / "tool";
    place_.cache = dir_ / "cache";
    place_.build = "b1", place_.machine = "a machine";
    script("");
  }
  /// `body` comes before the outputs are written.
  void script(const std::string& body) const {
    write_file(place_.tool, "#!/bin/sh\necho \"$@\" >> " + (dir_ / "calls").string() + "\n" + body + R"(
while [ $# -gt 0 ]; do
  if [ "$1" = -o ]; then echo content > "$2"; fi
  shift
done
echo '{"seconds": 2.5, "rays": 7}'
)");
    std::filesystem::permissions(place_.tool, std::filesystem::perms::owner_all);
  }
  static report::Expansion expansion(const std::string& methods, const std::string& more = "") {
    const report::Plan plan = report::parse_plan(
        R"({"scenes": [{"name": "s", "scene": "builtin:x"}], )" + more + R"("methods": )" + methods + "}",
        "plan", {"render", "bake", "hier", "measure"});
    return report::expand(plan, {"/nowhere", "1.0", {{"s", "hash"}}, 0});
  }
  static report::Expansion one() {
    return expansion(R"([{"name": "m", "steps": ["render {scene} -o o.exr"]}])");
  }
  RunResult run(const report::Expansion& expansion) const { return run_jobs(expansion, place_, 20, {}); }
  std::string calls() const {
    return std::filesystem::exists(dir_ / "calls") ? read_text_file(dir_ / "calls") : "";
  }

  const test::TempDir dir_;
  RunPlace place_;
};

TEST_F(ReportRun, KeepsWhatACommandLeftAndDoesNotRunItAgain) {
  const report::Expansion plan = one();
  const std::string key = plan.jobs[0].key;
  // What a run of the same number left that was killed is no part of this one.
  const std::filesystem::path work = place_.cache / (key + "." + std::to_string(::getpid()) + ".part");
  std::filesystem::create_directories(work);
  write_file(work / "junk", std::string_view("old"));

  const RunResult first = run(plan);
  EXPECT_EQ(first.done, 1u);
  EXPECT_EQ(first.cached, 0u);
  EXPECT_TRUE(first.failures.empty());
  EXPECT_EQ(calls(),
            "render builtin:x -o " + (work / "o.exr").string() + " --json --progress none --config none\n");
  const report::JobRecord& record = first.records.at(key);
  EXPECT_EQ(record.build, "b1");
  EXPECT_EQ(record.machine, "a machine");
  EXPECT_THAT(record.started, testing::MatchesRegex("2...-..-..T..:..:..Z"));
  EXPECT_GT(record.seconds, 0);
  EXPECT_GT(record.cpu_seconds, 0);
  EXPECT_GT(record.peak_bytes, 0u);
  EXPECT_EQ(record.result, "{\"seconds\": 2.5, \"rays\": 7}\n");
  EXPECT_EQ(record.files, (std::map<std::string, std::uint64_t>{{"log", 0}, {"o.exr", 8}, {"stdout", 28}}));
  EXPECT_FALSE(std::filesystem::exists(work));

  const RunResult second = run(plan);
  EXPECT_EQ(second.done, 0u);
  EXPECT_EQ(second.cached, 1u);
  EXPECT_EQ(second.records.at(key).started, record.started);
  place_.build = "b2";
  EXPECT_EQ(run(plan).done, 1u) << "another build's runs do not count";
  place_.build = "b3", place_.any_build = true;
  EXPECT_EQ(run(plan).cached, 1u) << "but when asked for";
}

TEST_F(ReportRun, SendsToAFarmWhatAFarmCanDo) {
  place_.farm = {"--broker", "ipc:///b"};
  const report::Expansion plan = expansion(
      R"([{"name": "m", "steps": ["bake {scene} -o p.sphl", "measure {scene} --probes p.sphl -o m.json"]}])");
  const RunResult result = run(plan);
  EXPECT_THAT(calls(),
              AllOf(HasSubstr("p.sphl --json --progress none --config none --broker ipc:///b\nmeasure"),
                    HasSubstr("m.json --json --progress none --config none\n")));
  EXPECT_EQ(result.records.at(plan.jobs[0].key).machine, "a machine and a farm");
  EXPECT_EQ(result.records.at(plan.jobs[1].key).machine, "a machine");
}

TEST_F(ReportRun, WhatNeedsAFailedStepIsNotRun) {
  script("case \"$1\" in bake) echo 'no such scene' >&2; exit 1;; esac");
  const report::Expansion plan = expansion(R"([
    {"name": "m", "steps": ["bake {scene} -o p.sphl", "hier p.sphl -o h.sphl", "render {scene} --probes h.sphl -o o.exr"]},
    {"name": "n", "steps": ["render {scene} -o o.exr"]}])");
  const RunResult result = run(plan);
  EXPECT_EQ(result.done, 1u);
  ASSERT_EQ(result.failures.size(), 3u);
  EXPECT_EQ(result.failures.at(plan.jobs[0].key), "ssphh bake: exited with 1; it said:\n  no such scene");
  EXPECT_EQ(result.failures.at(plan.jobs[1].key), "ssphh hier: was not run: bake failed");
  EXPECT_EQ(result.failures.at(plan.jobs[2].key), "ssphh render: was not run: hier failed");
  EXPECT_THAT(calls(), Not(HasSubstr("hier")));
}

TEST_F(ReportRun, ALongLogIsToldToItsEnd) {
  const auto failure = [&](int lines) {
    script("i=0; while [ $i -lt " + std::to_string(lines) +
           " ]; do i=$((i+1)); echo line $i >&2; done; exit 1");
    const report::Expansion plan = one();
    return run(plan).failures.at(plan.jobs[0].key);
  };
  EXPECT_THAT(failure(8), AllOf(HasSubstr("\n  line 1\n"), Not(HasSubstr("All of it"))));
  EXPECT_THAT(failure(9), HasSubstr("\n  line 9\nAll of it:\nline 1\nline 2\n"));
  // 9 · 7 + 90 · 8 + 900 · 9 bytes: the last 4000 are shown.
  const std::string text = failure(999);
  const std::string mark = "\nAll of it:\n…";
  ASSERT_THAT(text, HasSubstr(mark));
  EXPECT_EQ(text.size() - text.find(mark) - mark.size(), 4000u);
  EXPECT_THAT(text, testing::EndsWith("\nline 999\n"));
}

TEST_F(ReportRun, AnOutputThatWasNotWrittenIsAFailure) {
  script("exit 0");
  const report::Expansion plan = one();
  const RunResult result = run(plan);
  EXPECT_THAT(result.failures.at(plan.jobs[0].key), HasSubstr("was not written by render builtin:x"));
  EXPECT_EQ(result.done, 0u);
  EXPECT_TRUE(std::filesystem::is_empty(place_.cache));
}

TEST_F(ReportRun, CtrlCEndsItBetweenCommands) {
  CancelToken cancel;
  cancel.request();
  EXPECT_THROW(run_jobs(one(), place_, 20, {nullptr, &cancel}), Cancelled);
  EXPECT_EQ(calls(), "");
}

void write_picture(const std::filesystem::path& file, int width, float value) {
  image::Image picture(width, 2);
  for (float& x : picture.pixels) x = value;
  std::filesystem::create_directories(file.parent_path());
  image::write_image(file, picture);
}

/// A reference of 2, a method of two runs with 3 and 5 that also has a layer, and one that failed.
class Cells : public testing::Test {
 protected:
  Cells() {
    plan_ = report::parse_plan(R"({
      "scenes": [{"name": "s", "scene": "builtin:x", "insets": [{"name": "left", "at": [0, 0, 0.5, 1]}]}],
      "reference": {"steps": ["render {scene} --truth 1 -o t.exr"], "picture": "t.exr"},
      "methods": [
        {"name": "m", "repetitions": 2, "steps": ["bake {scene} -o p.sphl", "render {scene} --probes p.sphl -o o.exr"],
         "picture": "o.exr"},
        {"name": "f", "steps": ["render {scene} --bad 1 -o o.exr"], "picture": "o.exr"}],
      "layers": ["indirect"], "block": 2})",
                               "plan", {"render", "bake"});
    expansion_ = report::expand(plan_, {"/nowhere", "1.0", {{"s", "hash"}}, 0});
    float value = 2;
    double seconds = 1;
    for (const report::Job& job : expansion_.jobs) {
      if (job.words[2] == "--bad") {
        runs_.failures[job.key] = "it failed";
        continue;
      }
      report::JobRecord& record = runs_.records[job.key];
      record.command = "the command", record.started = "then", record.machine = "here";
      record.seconds = seconds, record.cpu_seconds = 3 * seconds, record.peak_bytes = 1000;
      record.result = R"({"rays": 5})";
      seconds *= 2;
      if (job.outputs[0] == "p.sphl") {
        record.files["p.sphl"] = 77;
        continue;
      }
      const std::string stem = job.outputs[0].substr(0, 1);
      write_picture(dir_.path() / job.key / job.outputs[0], 4, value);
      write_picture(dir_.path() / job.key / (stem + ".indirect.exr"), 4, 0.5f * value);
      value = value == 2 ? 3 : 5;
    }
  }
  std::vector<report::ReportCell> measure() const {
    return measure_cells(plan_, expansion_, runs_, dir_.path(), {});
  }

  const test::TempDir dir_;
  report::Plan plan_;
  report::Expansion expansion_;
  RunResult runs_;
};

TEST_F(Cells, HoldTheNumbersOfTheirRuns) {
  const std::vector<report::ReportCell> cells = measure();
  ASSERT_EQ(cells.size(), 3u);
  const report::ReportCell& m = cells[1];
  EXPECT_EQ(m.label, "m");
  EXPECT_EQ(m.method, 0);
  EXPECT_EQ(m.failure, "");
  ASSERT_EQ(m.steps.size(), 4u);
  const auto expect_step = [&](std::size_t i, const char* name, int repetition, double seconds) {
    const report::StepRun& step = m.steps[i];
    EXPECT_EQ(step.name, name);
    EXPECT_EQ(step.repetition, repetition);
    EXPECT_EQ(step.seconds, seconds);
    EXPECT_EQ(step.peak_bytes, 1000u);
    EXPECT_EQ(step.command, "the command");
    EXPECT_EQ(step.started, "then");
    EXPECT_EQ(step.machine, "here");
  };
  // Jobs 0 to 4 took 1, 2, 4, 8 and 16 seconds; the first is the reference's.
  expect_step(0, "bake", 0, 2), expect_step(1, "render", 0, 4);
  expect_step(2, "bake", 1, 8), expect_step(3, "render", 1, 16);
  EXPECT_EQ(m.steps[0].key, expansion_.jobs[1].key);
  const auto expect_value = [&](const char* name, double mean, int count) {
    ASSERT_TRUE(m.values.count(name)) << name;
    EXPECT_NEAR(m.values.at(name).mean, mean, 1e-6) << name;
    EXPECT_EQ(m.values.at(name).count, count) << name;
  };
  expect_value("seconds", (6 + 24) / 2.0, 2);
  expect_value("bake.wall_seconds", 5, 2);
  expect_value("render.cpu_seconds", 30, 2);
  expect_value("bake.peak_bytes", 1000, 2);
  expect_value("bake.file_bytes", 77, 2);
  expect_value("render.rays", 5, 2);
  EXPECT_FALSE(m.values.count("render.file_bytes"));
  // 3 and 5 against 2, in the layer 1.5 and 2.5 against 1; blocks of 2 × 2 pixels of three channels.
  expect_value("mae", 2, 2);
  expect_value("indirect:mae", 1, 2);
  expect_value("mean_ratio@left", 2, 2);
  expect_value("block_max", 24, 2);
  EXPECT_EQ(cells[0].values.count("mae"), 0u) << "the reference against itself";
  EXPECT_EQ(cells[0].exposure, -2.75)
      << "2 to a grey of 0.18, and three quarters brighter without highlights";
  EXPECT_EQ(cells[1].exposure, -3.25) << "of the first run";
  EXPECT_EQ(cells[2].exposure, 0);
}

TEST_F(Cells, HoldThePicturesOfTheFirstRun) {
  const std::vector<report::ReportCell> cells = measure();
  const auto expect_pictures = [](const report::ReportCell& cell,
                                  const std::vector<std::pair<std::string, std::string>>& wanted) {
    std::vector<std::pair<std::string, std::string>> got;
    for (const report::CellPicture& picture : cell.pictures) got.emplace_back(picture.layer, picture.map);
    EXPECT_EQ(got, wanted) << cell.label;
  };
  expect_pictures(cells[0], {{"", ""}, {"indirect", ""}});
  expect_pictures(cells[1], {{"", ""}, {"", "flip"}, {"indirect", ""}, {"indirect", "flip"}});
  EXPECT_EQ(report::unpack(cells[1].pictures[0].packed).front(), report::to_half(3));
  EXPECT_EQ(report::unpack(cells[1].pictures[2].packed).front(), report::to_half(1.5f));
  expect_pictures(cells[2], {});
}

TEST_F(Cells, AFailureIsThatOfTheStepThatFailed) {
  EXPECT_EQ(measure()[2].failure, "it failed");
  write_picture(dir_.path() / expansion_.jobs[2].key / "o.exr", 8, 3);
  EXPECT_THAT(measure()[1].failure, HasSubstr("sizes differ"));
}

TEST_F(Cells, WithoutItsReferenceACellHasItsPictureAlone) {
  const std::string key = expansion_.jobs[0].key;
  runs_.records.erase(key);
  runs_.failures[key] = "no truth";
  const std::vector<report::ReportCell> cells = measure();
  EXPECT_EQ(cells[0].failure, "no truth");
  EXPECT_EQ(cells[1].failure, "");
  EXPECT_EQ(cells[1].pictures.size(), 2u);
  EXPECT_EQ(cells[1].values.count("mae"), 0u);
}

}  // namespace
}  // namespace ssphh::app
