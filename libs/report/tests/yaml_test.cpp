#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/report/expansion.h>
#include <ssphh/report/plan.h>

#include "error_message.h"
#include "json_text.h"
#include "places.h"
#include "yaml_reader.h"

namespace ssphh::report {
namespace {

using testing::HasSubstr;

const std::vector<std::string> words_of_steps = {"render",  "bake",    "hier",    "truth", "sh",
                                                 "measure", "compare", "relight", "leak"};

const char* const plan = R"(# Degrees
title: Degrees
variables:
  width: 48
  exposure: 0.50
  label: "016"
scenes:
  - name: rooms
    scene: builtin:two-rooms --time 1
    optional: true
methods:
  - name: ssphh
    parameters: {degree: [2, 4, 9]}
    steps:
      - bake {scene} --degree {degree} -o p.sphl
      - name: picture
        run: render {scene} --width {width} -o p.exr
    picture: p.exr
)";

std::string message_of(std::string text, const std::string& what, const std::string& with) {
  text.replace(text.find(what), what.size(), with);
  try {
    parse_plan(text, "p.yaml", words_of_steps);
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

std::vector<std::string> keys(const Plan& p, const std::filesystem::path& folder) {
  ExpandContext context{folder, "1", {}, 0};
  for (const PlanScene& scene : p.scenes) context.scene_hashes[scene.name] = scene.name;
  std::vector<std::string> all;
  for (const Job& job : expand(p, context).jobs) all.push_back(job.key);
  return all;
}

// Every JSON document is a YAML document too: both readers must see the same in it.
TEST(YamlPlan, ShippedPlansSayTheSameInYamlAsInJson) {
  const std::filesystem::path folder = test::source_dir() / "plans";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    const std::string text = read_text_file(entry.path());
    const Plan json = parse_plan(text, "plan.json", words_of_steps),
               yaml = parse_plan(text, "plan.yaml", words_of_steps);
    EXPECT_EQ(keys(json, folder), keys(yaml, folder)) << entry.path();
    EXPECT_EQ(json.title, yaml.title);
    EXPECT_EQ(json.columns.size(), yaml.columns.size());
    ++count;
  }
  EXPECT_GT(count, 5);
}

TEST(YamlPlan, PlainScalarsHaveTheirTypeAndQuotedOnesAreText) {
  const Plan p = parse_plan(plan, "p.yaml", words_of_steps);
  EXPECT_EQ(p.title, "Degrees");
  EXPECT_EQ(p.variables, (Parameters{{"width", "48"}, {"exposure", "0.5"}, {"label", "016"}}));
  EXPECT_TRUE(p.scenes[0].optional);
  EXPECT_EQ(p.methods[0].variants.size(), 3u);
  EXPECT_EQ(p.methods[0].steps[1].name, "picture");
}

TEST(Yaml, PlainScalarsFollowTheCoreSchema) {
  const json::Value read = parse_yaml(R"(
nothing: [~, null, Null, NULL, ]
empty:
yes: [true, True, TRUE]
no: [false, False, FALSE]
whole: [12, +12, -12]
other: [1.5, +0.25, -1e3, .5]
text: [on, nUll, tRUE, 1x, 1.5.2, inf, nan, "", "7", '7', 0x1f]
)",
                                      "p");
  EXPECT_EQ(read["nothing"], (json::Value{nullptr, nullptr, nullptr, nullptr}));
  EXPECT_EQ(read["empty"], json::Value());
  EXPECT_EQ(read["yes"], (json::Value{true, true, true}));
  EXPECT_EQ(read["no"], (json::Value{false, false, false}));
  EXPECT_EQ(read["whole"], (json::Value{12, 12, -12}));
  EXPECT_TRUE(read["whole"][0].is_integer());
  EXPECT_EQ(read["other"], (json::Value{1.5, 0.25, -1000.0, 0.5}));
  EXPECT_EQ(read["text"],
            (json::Value{"on", "nUll", "tRUE", "1x", "1.5.2", "inf", "nan", "", "7", "7", "0x1f"}));
}

TEST(Yaml, FilesEndAsSuch) {
  EXPECT_TRUE(is_yaml_name("a.yaml"));
  EXPECT_TRUE(is_yaml_name("a.yml"));
  EXPECT_FALSE(is_yaml_name("a.json"));
  EXPECT_FALSE(is_yaml_name("yaml"));
}

TEST(Yaml, LinesAreThoseOfThePlaceAndItsKey) {
  const std::string text = "a: 1\nb:\n  - x: 1\n    y: 2\n  - 7\nc:\n  d: 3\n";
  const auto line = [&](const char* where, const char* key = "") { return yaml_line(text, "p", where, key); };
  EXPECT_EQ(line("p"), 1);
  EXPECT_EQ(line("p", "b"), 2);
  EXPECT_EQ(line("p: b[0]"), 3);
  EXPECT_EQ(line("p: b[0]", "y"), 4);
  EXPECT_EQ(line("p: b[0].y"), 4);
  EXPECT_EQ(line("p: b[1]"), 5);
  EXPECT_EQ(line("p: b[2]"), 3) << "the list, where there is no such item";
  EXPECT_EQ(line("p: c.d"), 7);
  EXPECT_EQ(line("p: c.e.f"), 7) << "as far as there is such a place";
  EXPECT_EQ(line("q: c"), 0);
}

TEST(Yaml, WhatIsNoneIsToldWithItsLine) {
  const auto message = [](const char* text) { return test::message_of([&] { parse_yaml(text, "p"); }); };
  EXPECT_THAT(message("a: 1\nb: [1, 2\n"), HasSubstr("p:3: is not YAML: "));
  EXPECT_THAT(message("a: 1\n[1, 2]: 3\n"), HasSubstr("p:2: a key must be text"));
  EXPECT_THAT(message("a: 1\nb: 2\na: 3\n"), HasSubstr("p:3: \"a\" stands twice"));
}

TEST(YamlPlan, ErrorsNameTheLineAndTheNearestKey) {
  const std::string unknown = message_of(plan, "    picture: p.exr", "    pictures: p.exr");
  EXPECT_THAT(unknown, HasSubstr("p.yaml:18: methods[0]"));
  EXPECT_THAT(unknown, HasSubstr("did you mean \"picture\"?"));
  EXPECT_THAT(message_of(plan, "        run:", "        ran:"),
              HasSubstr("p.yaml:16: methods[0].steps[1]: \"run\" is missing"));
  EXPECT_THAT(message_of(plan, "optional: true", "optional: maybe"),
              HasSubstr("p.yaml:10: scenes[0].optional"));
  EXPECT_THAT(message_of(plan, "- bake", "- bak"), HasSubstr("p.yaml:15: methods[0].steps[0]"));
  EXPECT_THAT(message_of(plan, "title: Degrees", "title: [Degrees"), HasSubstr("is not YAML"));
  EXPECT_THAT(message_of(plan, "  exposure", "  width"), HasSubstr("p.yaml:5: \"width\" stands twice"));
  EXPECT_THAT(message_of(plan, "# Degrees", "colour: red"), testing::StartsWith("p.yaml:1: unknown member"));
  EXPECT_THAT(message_of(plan, "    steps:", "    scenes: [roms]\n    steps:"),
              testing::StartsWith("p.yaml:12: methods[0]: unknown scene \"roms\""));
}

TEST(YamlPlan, AliasesThatMultiplyAreRefused) {
  std::string bomb = "a: &a [x, x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c < 'j'; ++c) {
    bomb += fmt::format("{}: &{} [", c, c);
    for (int i = 0; i < 10; ++i) bomb += fmt::format("{}*{} ", i ? ", " : "", static_cast<char>(c - 1));
    bomb += "]\n";
  }
  try {
    parse_plan(bomb, "p.yaml", words_of_steps);
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("over a million values"));
  }
}

}  // namespace
}  // namespace ssphh::report
