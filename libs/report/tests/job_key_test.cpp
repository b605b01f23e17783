/// A run that is kept may stand only for the command line that made it: keys hold every field of plan and
/// context that decides what a command does.

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/core/hash.h>
#include <ssphh/report/cache.h>
#include <ssphh/report/expansion.h>

#include "fields.h"
#include "temp_dir.h"

namespace ssphh::report {

void fields(auto& visit, Inset& i) {
  auto& [name, x0, y0, x1, y1, mask_file, mask] = i;
  visit("name", name), visit("x0", x0), visit("y0", y0), visit("x1", x1), visit("y1", y1);
  visit("mask_file", mask_file), visit("mask", mask.pixels);
}
void fields(auto& visit, PlanScene& s) {
  auto& [name, title, words, exposure, variables, insets, optional] = s;
  visit("name", name), visit("title", title), visit("words", words), visit("exposure", exposure);
  visit("variables", variables), visit("insets", insets), visit("optional", optional);
}
void fields(auto& visit, Step& s) {
  auto& [name, words] = s;
  visit("name", name), visit("words", words);
}
void fields(auto& visit, PlanMethod& m) {
  auto& [name, title, about, steps, picture, halves, variants, repetitions, scenes] = m;
  visit("name", name), visit("title", title), visit("about", about), visit("steps", steps);
  visit("picture", picture), visit("halves", halves), visit("variants", variants);
  visit("repetitions", repetitions), visit("scenes", scenes);
}
void fields(auto& visit, Column& c) {
  auto& [value, title, unit, better] = c;
  visit("value", value), visit("title", title), visit("unit", unit), visit("better", better);
}
void fields(auto& visit, Chart& c) {
  auto& [title, x, y, log_x, log_y] = c;
  visit("title", title), visit("x", x), visit("y", y), visit("log_x", log_x), visit("log_y", log_y);
}
void fields(auto& visit, Published& p) {
  auto& [scene, method, values] = p;
  visit("scene", scene), visit("method", method), visit("values", values);
}
void fields(auto& visit, Plan& p) {
  auto& [title, about, variables, scenes, has_reference, reference, methods, layers, columns, charts,
         published_source, published, block, time_limit] = p;
  visit("title", title), visit("about", about), visit("variables", variables), visit("scenes", scenes);
  visit("has_reference", has_reference), visit("reference", reference), visit("methods", methods);
  visit("layers", layers), visit("columns", columns), visit("charts", charts);
  visit("published_source", published_source), visit("published", published), visit("block", block);
  visit("time_limit", time_limit);
}
void fields(auto& visit, ExpandContext& c) {
  auto& [folder, version, scene_hashes, threads] = c;
  static_cast<void>(folder);  // a path: FilesCountByContentNotByPlace
  visit("version", version), visit("scene_hashes", scene_hashes), visit("threads", threads);
}
void fields(auto& visit, JobRecord& r) {
  auto& [command, build, machine, started, seconds, cpu_seconds, peak_bytes, files, result] = r;
  visit("command", command), visit("build", build), visit("machine", machine), visit("started", started);
  visit("seconds", seconds), visit("cpu_seconds", cpu_seconds), visit("peak_bytes", peak_bytes);
  visit("files", files), visit("result", result);
}

namespace {

using test::expect_a_key_of_every_field;
using test::Undecisive;

Plan example_plan() {
  Plan plan = parse_plan(R"({
    "title": "T", "about": "A", "variables": {"w": 48, "spp": 2},
    "scenes": [{"name": "s", "scene": "builtin:x --time 1", "variables": {"spp": 3}, "exposure": 0.5,
                "insets": [{"name": "i", "at": [0, 0.25, 0.5, 1]}]},
               {"name": "t", "scene": "builtin:y"}],
    "reference": {"steps": ["render {scene} --spp {spp} --aov direct -o truth.exr"], "picture": "truth.exr"},
    "methods": [{"name": "m", "parameters": [{"depth": 1}, {"depth": 4}], "repetitions": 2, "scenes": ["s", "t"],
                 "steps": ["bake {scene} --degree {depth} -o p.sphl --save q.sphl", "hier p.sphl -o h.sphl",
                           {"name": "r", "run": "render {scene} --width {w} --probes h.sphl --more q.sphl -o o.exr"}]},
                {"name": "n", "scenes": ["t"], "steps": ["render {scene} --spp {spp} --width {w} -o o.exr"]}],
    "layers": ["indirect"], "columns": ["flip"], "charts": [{"x": "depth", "y": "relmse"}],
    "published": {"source": "me", "rows": [{"scene": "s", "method": "m, depth 1", "values": {"R": 1.5}}]}})",
                         "plan", {"render", "bake", "hier"});
  plan.reference.picture.clear();  // or another output's name were an error, the same for several fields
  return plan;
}

ExpandContext context_of_two() {
  return {"/nowhere", "1.0", {{"s", "hash of s"}, {"t", "hash of t"}}, 3};
}

/// Of all jobs; of the reason where the plan asks for what cannot be.
Hash128 keys_of(const Plan& plan, const ExpandContext& context) {
  Hasher all;
  try {
    for (const Job& job : expand(plan, context).jobs) all.text(job.key);
  } catch (const Error& e) {
    all.text(e.what());
  }
  return all.finish();
}

TEST(JobKey, HoldsEveryFieldOfThePlanThatACommandSees) {
  Undecisive undecisive = {
      {"title", "for people"},
      {"about", "for people"},
      {"layers", "what is measured of a run, not what is run"},
      {"columns", "what is shown of a run, not what is run"},
      {"charts", "what is shown of a run, not what is run"},
      {"published", "numbers of others"},
      {"block", "how errors are measured"},
      {"time_limit", "a run that it stops is not kept"},
  };
  for (const char* scene : {"scenes/0/", "scenes/1/"}) {
    for (const char* field : {"title", "exposure", "insets", "optional"})
      undecisive[scene + std::string(field)] = "how results are shown and measured, not how they are made";
  }
  for (const char* method : {"reference/", "methods/0/", "methods/1/"}) {
    for (const char* field : {"name", "title", "about"})
      undecisive[method + std::string(field)] = "for people";
  }
  for (const char* step : {"reference/steps/0/", "methods/0/steps/0/", "methods/0/steps/1/",
                           "methods/0/steps/2/", "methods/1/steps/0/"})
    undecisive[step + std::string("name")] = "by which columns call it";
  for (const char* list : {"variables/", "scenes/0/variables/", "scenes/1/variables/",
                           "methods/0/variants/0/", "methods/0/variants/1/", "methods/1/variants/0/"})
    undecisive[list + std::string("size")] = "one more, which no step names";
  for (const char* scene : {"scenes/0/words/0", "scenes/1/words/0"})
    undecisive[scene] = "where the scene lies; its hash is in the key";
  undecisive["methods/1/variants/size"] = "the same command once more";
  undecisive["scenes/size"] = "a scene without a hash is left out";
  undecisive["methods/0/scenes/size"] = undecisive["methods/1/scenes/size"] = "no scene is called \"\"";
  undecisive["reference/variants"] = "a reference has none";
  undecisive["reference/scenes"] = "a reference is of all scenes";
  expect_a_key_of_every_field(
      example_plan(), [](const Plan& plan) { return keys_of(plan, context_of_two()); }, undecisive);
}

TEST(JobKey, HoldsEveryFieldOfTheContext) {
  expect_a_key_of_every_field(context_of_two(),
                              [](const ExpandContext& c) { return keys_of(example_plan(), c); });
}

TEST(JobKey, HoldsWhichOfTheEarlierFilesIsRead) {
  const auto render_key = [](const char* probes) {
    Plan plan = example_plan();
    plan.methods[0].steps[2].words[5] = probes;
    for (const Job& job : expand(plan, context_of_two()).jobs)
      if (job.words.size() > 5 && job.words[5].starts_with('@')) return job.key;
    return std::string("no step reads what an earlier one wrote");
  };
  EXPECT_NE(render_key("p.sphl"), render_key("q.sphl")) << "of one step";
  EXPECT_NE(render_key("p.sphl"), render_key("h.sphl")) << "of two";
}

// --seed of the plan wins over the repetition's, so that its repetitions are one run.
TEST(JobKey, RepetitionsOfAStepWithASeedOfItsOwnAreOneRun) {
  Plan plan = example_plan();
  std::vector<std::string>& words = plan.methods[1].steps[0].words;
  words.insert(words.end(), {"--seed", "7"});
  const Hash128 once = keys_of(plan, context_of_two());
  plan.methods[1].repetitions = 3;
  EXPECT_EQ(keys_of(plan, context_of_two()), once);
}

// One in the plan's folder, however the option is written.
TEST(JobKey, AFileOfAnOptionCountsByContent) {
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--environment", "sky.hdr"}, {"--environment=sky.hdr"}}) {
    Plan plan = example_plan();
    std::vector<std::string>& words = plan.methods[1].steps[0].words;
    words.insert(words.end(), option.begin(), option.end());
    std::vector<Hash128> keys;
    for (const char* content : {"abc", "abc", "abd"}) {
      const test::TempDir dir;
      write_file(dir / "sky.hdr", std::string_view(content));
      ExpandContext here = context_of_two();
      here.folder = dir.path();
      keys.push_back(keys_of(plan, here));
      const std::vector<std::string> made = expand(plan, here).jobs.back().words;
      EXPECT_THAT(made, testing::Contains(testing::EndsWith((dir / "sky.hdr").string())));
    }
    EXPECT_EQ(keys[0], keys[1]) << option[0];
    EXPECT_NE(keys[0], keys[2]) << option[0] << ": another sky";
  }
}

TEST(JobKey, AFileThatTheSceneNamesCountsByContent) {
  const test::TempDir dir;
  Plan plan = example_plan();
  plan.scenes[1].words.insert(plan.scenes[1].words.end(), {"--overlay", "lamps.json"});
  ExpandContext here = context_of_two();
  here.folder = dir.path();
  const Hash128 without = keys_of(plan, here);
  write_file(dir / "lamps.json", std::string_view("{}"));
  const Hash128 with = keys_of(plan, here);
  EXPECT_NE(with, without);
  const test::TempDir other;
  write_file(other / "lamps.json", std::string_view("{ }"));
  here.folder = other.path();
  EXPECT_NE(keys_of(plan, here), with);
  write_file(other / "lamps.json", std::string_view("{}"));
  EXPECT_EQ(keys_of(plan, here), with) << "the same file, written anew";
}

TEST(Cache, ARecordHoldsEveryFieldOfARun) {
  const test::TempDir dir;
  const Job job = expand(example_plan(), context_of_two()).jobs[1];
  JobRecord record;
  auto& [command, build, machine, started, seconds, cpu_seconds, peak_bytes, files, result] = record;
  build = "b1", machine = "M", started = "2026-01-02T03:04:05Z";
  seconds = 1.0 / 3, cpu_seconds = 2.0 / 3, peak_bytes = (std::uint64_t{1} << 40) + 7;
  std::filesystem::create_directories(dir / "work");
  for (const std::string& output : job.outputs) write_file(dir / "work" / output, output + output);
  write_file(dir / "work/stdout", std::string_view("{\"x\": 2}"));
  keep_run(dir.path(), job, dir / "work", record);
  const auto found = find_run(dir.path(), job.key, "b1");
  ASSERT_TRUE(found);
  command = "bake builtin:x --time 1 --degree 1 -o p.sphl --save q.sphl --threads 3";
  files = {{"p.sphl", 12}, {"q.sphl", 12}, {"stdout", 8}}, result = "{\"x\": 2}";
  test::expect_same_fields(*found, record);
}

}  // namespace
}  // namespace ssphh::report
