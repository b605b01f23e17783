#include <filesystem>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/report/cache.h>
#include <ssphh/report/jobs.h>

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

TEST(Cache, AMissingOutputIsNoRun) {
  const TempDir dir;
  const Job job = expand(plan_of(chain), context()).jobs[0];
  std::filesystem::create_directories(dir / "work");
  EXPECT_THROW(keep_run(dir.path(), job, dir / "work", {}), Error);
}

}  // namespace
}  // namespace ssphh::report
