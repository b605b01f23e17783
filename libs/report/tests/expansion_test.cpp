#include <filesystem>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/report/cache.h>
#include <ssphh/report/expansion.h>

#include "error_message.h"
#include "json_text.h"
#include "temp_dir.h"

namespace ssphh::report {
namespace {

using test::TempDir;

Plan plan_of(const std::string& methods, const std::string& extra = "") {
  return parse_plan(R"({"variables": {"w": 4}, "scenes": [{"name": "s", "scene": "builtin:x --time 1"}], )" +
                        extra + R"("methods": )" + methods + "}",
                    "plan", {"render", "bake", "hier"});
}

const char* chain = R"([{"name": "m", "steps": ["bake {scene} -o p.sphl", "hier p.sphl -o h.sphl",
                                              "render {scene} --width {w} --probes h.sphl -o o.exr"], "picture": "o.exr"}])";

ExpandContext context() {
  return {"/nowhere", "1.0", {{"s", "hash"}}, 0};
}

std::vector<std::string> keys(const Expansion& e) {
  std::vector<std::string> result;
  for (const Job& job : e.jobs) result.push_back(job.key);
  return result;
}

TEST(Jobs, StepsReadWhatEarlierOnesWrote) {
  const Expansion e = expand(plan_of(chain), context());
  ASSERT_EQ(e.jobs.size(), 3u);
  EXPECT_THAT(e.jobs[1].words, testing::ElementsAre("hier", "@" + e.jobs[0].key + "/p.sphl", "-o", "h.sphl"));
  EXPECT_THAT(e.jobs[2].needs, testing::ElementsAre(1u));
  EXPECT_EQ(e.cells[0].runs[0].pictures[0], e.jobs[2].key + "/o.exr");
  EXPECT_THAT(command_line(e.jobs[1], "/cache", "/work"),
              testing::ElementsAre("hier", "/cache/" + e.jobs[0].key + "/p.sphl", "-o", "/work/h.sphl"));
  EXPECT_THAT(e.jobs[2].words, testing::IsSupersetOf({"builtin:x", "--time", "4"}));
}

TEST(Jobs, EqualCommandsRunOnce) {
  const Expansion e = expand(plan_of(R"([
    {"name": "a", "steps": ["bake {scene} -o p.sphl", "render {scene} --probes p.sphl -o a.exr"]},
    {"name": "b", "steps": ["bake {scene} -o p.sphl", "render {scene} --probes p.sphl --lookup light -o a.exr"]}])"),
                             context());
  EXPECT_EQ(e.jobs.size(), 3u);
  EXPECT_EQ(e.cells[0].runs[0].jobs[0], e.cells[1].runs[0].jobs[0]);
}

TEST(Jobs, FilesBesideAnOutputAreItsWriters) {
  const Expansion e = expand(
      plan_of(R"([{"name": "m", "steps": ["render {scene} -o o.exr"], "halves": ["o.a.exr", "o.b.exr"]}])"),
      context());
  EXPECT_EQ(e.cells[0].runs[0].pictures[1], e.jobs[0].key + "/o.b.exr");
  EXPECT_THROW(expand(plan_of(R"([{"name": "m", "steps": ["render {scene} -o o.exr"], "picture": "p.exr"}])"),
                      context()),
               Error);
  EXPECT_THROW(expand(plan_of(R"([{"name": "m", "steps": ["render {scene} -o ../o.exr"]}])"), context()),
               Error);
}

TEST(Jobs, RepetitionsDifferInTheirSeedAlone) {
  const Expansion e = expand(
      plan_of(R"([{"name": "m", "repetitions": 3, "steps": ["render {scene} -o o.exr"]}])"), context());
  ASSERT_EQ(e.jobs.size(), 3u);
  EXPECT_THAT(e.jobs[0].words, testing::Not(testing::Contains("--seed")));
  EXPECT_EQ(e.jobs[2].words.back(), "2");
  EXPECT_EQ(e.jobs[2].words[e.jobs[2].words.size() - 2], "--seed");
}

TEST(Jobs, EverythingThatMattersChangesTheKey) {
  const Plan plan = plan_of(chain);
  const std::vector<std::string> base = keys(expand(plan, context()));
  ExpandContext version = context(), scene = context(), threads = context();
  version.version = "1.1", scene.scene_hashes["s"] = "other", threads.threads = 1;
  for (const ExpandContext& changed : {version, scene, threads}) {
    const std::vector<std::string> other = keys(expand(plan, changed));
    for (std::size_t i = 0; i < base.size(); ++i) EXPECT_NE(other[i], base[i]) << i;
  }
  Plan wider = plan;
  set_variable(wider, "w=5");
  const std::vector<std::string> other = keys(expand(wider, context()));
  EXPECT_EQ(other[0], base[0]);
  EXPECT_EQ(other[1], base[1]);
  EXPECT_NE(other[2], base[2]);
  Plan later = plan;
  later.scenes[0].words.back() = "2";  // --time
  EXPECT_NE(keys(expand(later, context()))[2], base[2]);
  Plan baked = plan;
  baked.methods[0].steps[0].words.insert(baked.methods[0].steps[0].words.end(), {"--degree", "3"});
  EXPECT_NE(keys(expand(baked, context()))[2], base[2]) << "what an earlier step made is part of a key";
}

TEST(Jobs, WhatDoesNotMatterLeavesTheKey) {
  const std::string a = R"([{"name": "m", "steps": ["bake {scene} -o p.sphl"], "about": "x"}])";
  const std::string b = R"([{"about": "y", "steps": ["bake  {scene}   -o p.sphl"], "name": "n"}])";
  EXPECT_EQ(keys(expand(plan_of(a), context())),
            keys(expand(plan_of(b, R"("title": "other", "block": 4, )"), context())));
}

TEST(Jobs, FilesCountByContentNotByPlace) {
  const TempDir one, two;
  write_file(one / "env.hdr", std::string_view("abc"));
  write_file(two / "env.hdr", std::string_view("abc"));
  const Plan plan = plan_of(R"([{"name": "m", "steps": ["render {scene} --environment env.hdr -o o.exr"]}])");
  ExpandContext here = context(), there = context();
  here.folder = one.path(), there.folder = two.path();
  const std::vector<std::string> base = keys(expand(plan, here));
  EXPECT_EQ(keys(expand(plan, there)), base);
  const TempDir three;
  write_file(three / "env.hdr", std::string_view("abd"));
  there.folder = three.path();
  EXPECT_NE(keys(expand(plan, there)), base);
}

TEST(Jobs, AFileThatIsCalledLikeAValueIsNoPath) {
  const TempDir dir;
  write_file(dir / "path", std::string_view("x"));
  ExpandContext here = context();
  here.folder = dir.path();
  const Expansion e =
      expand(plan_of(R"([{"name": "m", "steps": ["render {scene} --method path -o o.exr"]}])"), here);
  EXPECT_THAT(e.jobs[0].words, testing::Contains("path"));
}

TEST(Jobs, ScenesWithoutAHashAreLeftOut) {
  ExpandContext none = context();
  none.scene_hashes.clear();
  EXPECT_TRUE(expand(plan_of(chain), none).cells.empty());
}

TEST(Jobs, AllOptionsThatNameAnOutputDo) {
  const Expansion e = expand(plan_of(R"([{"name": "m", "steps": [
      "render {scene} -o a.exr --png b.png --save c.sphl --output d.exr --other e.exr"]}])"),
                             context());
  EXPECT_THAT(e.jobs[0].outputs, testing::ElementsAre("a.exr", "b.png", "c.sphl", "d.exr"));
  EXPECT_THAT(
      command_line(e.jobs[0], "/cache", "/work"),
      testing::ElementsAre("render", "builtin:x", "--time", "1", "-o", "/work/a.exr", "--png", "/work/b.png",
                           "--save", "/work/c.sphl", "--output", "/work/d.exr", "--other", "e.exr"));
}

TEST(Jobs, AnOutputIsABareName) {
  for (const char* bad : {"a/b.exr", "''", ".", ".."}) {
    const Plan plan = plan_of(R"([{"name": "m", "steps": [{"name": "first", "run": "render {scene} -o )" +
                              std::string(bad) + R"("}]}])");
    EXPECT_THAT(
        test::message_of([&] { expand(plan, context()); }),
        testing::HasSubstr("step first: output \"" + std::string(bad == std::string("''") ? "" : bad) +
                           "\" must be a bare name"))
        << bad;
  }
  EXPECT_THAT(test::message_of([&] {
                expand(
                    plan_of(R"([{"name": "m", "steps": ["render {scene} -o o.exr"], "picture": "p.exr"}])"),
                    context());
              }),
              testing::HasSubstr("method m: no step writes \"p.exr\""));
}

// OUT.exr stands for OUT.a.exr, but not for OUT.a.hdr, OTHER.exr or a name without an extension.
TEST(Jobs, WhatLiesBesideAnOutputHasItsStemAndExtension) {
  const auto reads = [](const std::string& name) {
    const Expansion e =
        expand(plan_of(R"([{"name": "m", "steps": ["bake {scene} -o o.exr", "render {scene} --probes )" +
                       name + R"("]}])"),
               context());
    return !e.jobs[1].needs.empty();
  };
  EXPECT_TRUE(reads("o.exr"));
  EXPECT_TRUE(reads("o.a.exr"));
  EXPECT_FALSE(reads("o.a.hdr"));
  EXPECT_FALSE(reads("oo.exr"));
  EXPECT_FALSE(reads("o"));
}

TEST(Jobs, AFileOfTwoWritersIsThatOfTheLast) {
  const Expansion e = expand(plan_of(R"([{"name": "m", "picture": "p.exr", "steps": [
      {"name": "a", "run": "bake {scene} -o p.exr"}, {"name": "b", "run": "render {scene} -o p.exr"}]}])"),
                             context());
  EXPECT_EQ(e.cells[0].runs[0].pictures[0], e.jobs[1].key + "/p.exr");
}

TEST(Jobs, CellsComeByScenesTheirReferenceFirst) {
  const Plan plan = parse_plan(R"({
    "scenes": [{"name": "s", "scene": "a"}, {"name": "t", "scene": "b"}, {"name": "gone", "scene": "c"}],
    "reference": {"steps": ["render {scene} -o t.exr"], "picture": "t.exr"},
    "methods": [{"name": "m", "parameters": {"n": [1, 2]}, "steps": ["render {scene} --n {n}"]},
                {"name": "only t", "scenes": ["t"], "steps": ["render {scene} --x"], "repetitions": 2}]})",
                               "plan", {"render"});
  const Expansion e = expand(plan, {"/nowhere", "1.0", {{"s", "h"}, {"t", "i"}}, 0});
  std::string cells;
  for (const Cell& cell : e.cells)
    cells += std::to_string(cell.scene) + " " + std::to_string(cell.method) + " " + cell.label + " " +
             std::to_string(cell.runs.size()) + "; ";
  EXPECT_EQ(cells,
            "0 -1 reference 1; 0 0 m, n 1 1; 0 0 m, n 2 1; 1 -1 reference 1; 1 0 m, n 1 1; 1 0 m, n 2 1; "
            "1 1 only t 2; ");
  EXPECT_EQ(e.cells[1].parameters, (Parameters{{"n", "1"}}));
  EXPECT_EQ(e.jobs[0].scene, "s");
  EXPECT_EQ(e.jobs.back().scene, "t");
}

TEST(Jobs, ValuesOfTheSceneComeBeforeThePlansAndThoseOfTheMethodBeforeBoth) {
  const Plan plan = parse_plan(R"({"variables": {"a": 1, "b": 1, "c": 1},
    "scenes": [{"name": "s", "scene": "x", "variables": {"b": 2, "c": 2}}],
    "methods": [{"name": "m", "parameters": {"c": [3]}, "steps": ["render {scene} {a} {b} {c}"]}]})",
                               "plan", {"render"});
  EXPECT_THAT(expand(plan, {"/nowhere", "1.0", {{"s", "h"}}, 2}).jobs[0].words,
              testing::ElementsAre("render", "x", "1", "2", "3", "--threads", "2"));
}

TEST(Jobs, AnOptionOfThePlanIsNotGivenTwice) {
  const Plan plan = plan_of(R"([{"name": "m", "steps": ["render {scene} --threads 7"]}])");
  ExpandContext threads = context();
  threads.threads = 3;
  EXPECT_THAT(expand(plan, threads).jobs[0].words,
              testing::ElementsAre("render", "builtin:x", "--time", "1", "--threads", "7"));
}

TEST(Jobs, AnEarlierFileIsNamedByItsKeyOf32Digits) {
  Job job;
  const std::string key(32, 'a');
  job.words = {"hier",     "@" + key + "/p",  "@" + key + "/", "@" + key,
               "@short/p", "@" + key + "x/p", "x" + key + "/p"};
  EXPECT_THAT(command_line(job, "/cache", "/work"),
              testing::ElementsAre("hier", "/cache/" + key + "/p", "@" + key + "/", "@" + key, "@short/p",
                                   "@" + key + "x/p", "x" + key + "/p"));
}

TEST(Jobs, AFileInThePlansFolderComesBeforeOneInTheCurrent) {
  const TempDir dir, current;
  write_file(dir / "sky.hdr", std::string_view("plan's"));
  write_file(current / "sky.hdr", std::string_view("current"));
  write_file(current / "other.hdr", std::string_view("current"));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(current.path());
  PlanScene scene;
  scene.words = {"sky.hdr", "other.hdr", "-other.hdr", "--x=sky.hdr", "none.hdr"};
  const std::vector<std::string> words = scene_words(scene, dir.path());
  std::filesystem::current_path(before);
  EXPECT_THAT(words, testing::ElementsAre((dir / "sky.hdr").string(), (current / "other.hdr").string(),
                                          "-other.hdr", "--x=" + (dir / "sky.hdr").string(), "none.hdr"));
}

TEST(Cache, KeepsAndFindsARun) {
  const TempDir dir;
  const Job job = expand(plan_of(chain), context()).jobs[0];
  EXPECT_FALSE(find_run(dir.path(), job.key, ""));
  const auto make = [&](const char* build) {
    std::filesystem::create_directories(dir / "work");
    write_file(dir / "work/p.sphl", std::string_view("1234"));
    write_file(dir / "work/stdout", std::string_view("{\"seconds\": 2}"));
    JobRecord record;
    record.build = build, record.seconds = 1.5, record.peak_bytes = 7;
    keep_run(dir.path(), job, dir / "work", record);
  };
  make("b1");
  const auto found = find_run(dir.path(), job.key, "b1");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->seconds, 1.5);
  EXPECT_EQ(found->files.at("p.sphl"), 4u);
  EXPECT_EQ(found->result, "{\"seconds\": 2}");
  EXPECT_FALSE(find_run(dir.path(), job.key, "b2")) << "another build's";
  EXPECT_TRUE(find_run(dir.path(), job.key, ""));
  make("b2");
  EXPECT_TRUE(find_run(dir.path(), job.key, "b2")) << "replaced";
  write_file(dir.path() / job.key / "p.sphl", std::string_view("12"));
  EXPECT_FALSE(find_run(dir.path(), job.key, "")) << "a file is not as it was";
}

TEST(Cache, WhatIsNotAsItWasWrittenIsNoRun) {
  const TempDir dir;
  const Job job = expand(plan_of(chain), context()).jobs[0];
  const auto make = [&] {
    std::filesystem::create_directories(dir / "work/folder");
    write_file(dir / "work/p.sphl", std::string_view("1234"));
    write_file(dir / "work/stdout", std::string_view("{}"));
    keep_run(dir.path(), job, dir / "work", {});
    return find_run(dir.path(), job.key, "");
  };
  const std::filesystem::path record = dir.path() / job.key / "run.json";
  const auto kept = make();
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->files.size(), 2u) << "folders do not count";
  const auto json = test::parse_json(read_text_file(record));
  EXPECT_EQ(json["key"], job.key);
  for (const auto& [key, value] : json.members()) {
    if (key == "key") continue;
    json::Value less = json;
    less.erase(key);
    write_file(record, print(less));
    EXPECT_FALSE(find_run(dir.path(), job.key, "")) << "without " << key;
  }
  write_file(record, std::string_view("{"));
  EXPECT_FALSE(find_run(dir.path(), job.key, ""));
  EXPECT_TRUE(make());
  std::filesystem::remove(dir.path() / job.key / "stdout");
  EXPECT_FALSE(find_run(dir.path(), job.key, ""));
}

TEST(Cache, AMissingOutputIsNoRun) {
  const TempDir dir;
  const Job job = expand(plan_of(chain), context()).jobs[0];
  std::filesystem::create_directories(dir / "work");
  EXPECT_EQ(test::message_of([&] { keep_run(dir.path(), job, dir / "work", {}); }),
            "p.sphl: was not written by bake builtin:x --time 1 -o p.sphl");
}

}  // namespace
}  // namespace ssphh::report
