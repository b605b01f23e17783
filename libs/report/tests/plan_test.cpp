#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/report/plan.h>

#include "json_schema.h"
#include "places.h"

namespace ssphh::report {
namespace {

using nlohmann::ordered_json;

const std::vector<std::string> commands = {"render", "bake", "hier", "truth", "sh", "measure"};

ordered_json valid() {
  return ordered_json::parse(R"({
    "title": "T",
    "variables": {"width": 48, "spp": 2},
    "scenes": [{"name": "s", "scene": "builtin:two-rooms --time 1", "variables": {"spp": 3},
                "insets": [{"name": "i", "at": [0, 0.25, 0.5, 1]}]}],
    "reference": {"steps": ["truth {scene} --halves -o truth.exr"], "halves": ["truth.a.exr", "truth.b.exr"]},
    "methods": [{"name": "m", "parameters": {"depth": [1, 4], "n": ["a", "b"]}, "repetitions": 2,
                 "steps": ["render {scene} --max-depth {depth} --camera '{n} x' -o p.exr"], "picture": "p.exr"}],
    "layers": ["indirect"],
    "columns": ["flip", {"value": "render.seconds", "title": "R", "unit": "s", "better": "less"}],
    "charts": [{"x": "depth", "y": "relmse", "log_y": true}],
    "published": {"source": "me", "rows": [{"scene": "s", "method": "m, depth 1, n a", "values": {"R": 1.5}}]},
    "block": 8, "time_limit": 60
  })");
}

Plan parse(const ordered_json& json) {
  return parse_plan(json.dump(), "plan", commands);
}

// The message of the Error that a changed plan gives.
std::string message_of(const std::function<void(ordered_json&)>& change) {
  ordered_json json = valid();
  change(json);
  try {
    parse(json);
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

std::vector<std::string> schema_errors(const ordered_json& json) {
  return test::schema_errors(test::source_dir() / "schemas/report-plan.schema.json", json.dump());
}

TEST(Plan, EverythingIsRead) {
  const Plan plan = parse(valid());
  EXPECT_EQ(plan.title, "T");
  EXPECT_THAT(plan.scenes[0].words, testing::ElementsAre("builtin:two-rooms", "--time", "1"));
  EXPECT_EQ(plan.scenes[0].variables, (Parameters{{"spp", "3"}}));
  EXPECT_DOUBLE_EQ(plan.scenes[0].insets[0].y0, 0.25);
  ASSERT_EQ(plan.methods[0].variants.size(), 4u);  // every combination
  EXPECT_EQ(label(plan.methods[0], plan.methods[0].variants[1]), "m, depth 1, n b");
  EXPECT_EQ(plan.methods[0].repetitions, 2);
  EXPECT_EQ(plan.methods[0].steps[0].name, "render");
  EXPECT_THAT(plan.methods[0].steps[0].words, testing::Contains("{n} x"));
  EXPECT_EQ(plan.columns[1].better, -1);
  EXPECT_TRUE(plan.charts[0].log_y);
  EXPECT_DOUBLE_EQ(plan.published[0].values.at("R"), 1.5);
  EXPECT_EQ(plan.block, 8);
}

TEST(Plan, ParametersAsListStandForThemselves) {
  ordered_json json = valid();
  json["published"]["rows"] = ordered_json::array();
  json["methods"][0]["parameters"] = {{{"depth", 25}, {"n", "x"}}, {{"depth", 3}, {"n", "y"}}};
  const Plan plan = parse(json);
  ASSERT_EQ(plan.methods[0].variants.size(), 2u);
  EXPECT_EQ(label(plan.methods[0], plan.methods[0].variants[1]), "m, depth 3, n y");
}

TEST(Plan, UnknownNamesAreAnsweredWithTheNearest) {
  using testing::HasSubstr;
  EXPECT_THAT(message_of([](auto& j) { j["titel"] = "x"; }),
              AllOf(HasSubstr("\"titel\""), HasSubstr("\"title\"")));
  EXPECT_THAT(message_of([](auto& j) { j["scenes"][0]["exposre"] = 1; }),
              AllOf(HasSubstr("scenes[0]"), HasSubstr("\"exposure\"")));
  EXPECT_THAT(message_of([](auto& j) { j["methods"][0]["repetition"] = 1; }), HasSubstr("\"repetitions\""));
  EXPECT_THAT(message_of([](auto& j) { j["layers"] = {"indirekt"}; }), HasSubstr("\"indirect\""));
  EXPECT_THAT(message_of([](auto& j) { j["methods"][0]["steps"][0] = "rendr {scene}"; }),
              HasSubstr("\"render\""));
  EXPECT_THAT(
      message_of([](auto& j) { j["methods"][0]["steps"][0] = "render {scene} --width {widht} -o p.exr"; }),
      HasSubstr("\"width\""));
  EXPECT_THAT(message_of([](auto& j) { j["scenes"][0]["variables"]["sp"] = 1; }), HasSubstr("\"spp\""));
  EXPECT_THAT(message_of([](auto& j) { j["published"]["rows"][0]["method"] = "m, depth 2, n a"; }),
              HasSubstr("did you mean \"m, depth 1, n a\""));
  EXPECT_THAT(message_of([](auto& j) { j["columns"][1]["titel"] = 1; }), HasSubstr("\"title\""));
}

TEST(Plan, WrongValuesAreNamedWithTheirPlace) {
  using testing::HasSubstr;
  EXPECT_THAT(message_of([](auto& j) { j.erase("scenes"); }), HasSubstr("\"scenes\" is missing"));
  EXPECT_THAT(message_of([](auto& j) { j["scenes"] = ordered_json::array(); }), HasSubstr("plan/scenes"));
  EXPECT_THAT(message_of([](auto& j) { j["block"] = 0; }), HasSubstr("plan/block"));
  EXPECT_THAT(message_of([](auto& j) { j["block"] = 1.5; }), HasSubstr("whole number"));
  EXPECT_THAT(message_of([](auto& j) { j["methods"][0]["repetitions"] = 0; }), HasSubstr("repetitions"));
  EXPECT_THAT(message_of([](auto& j) {
                j["scenes"][0]["insets"][0]["at"] = {0, 0, 0, 1};
              }),
              HasSubstr("left < right"));
  EXPECT_THAT(message_of([](auto& j) { j["reference"]["picture"] = "x.exr"; }), HasSubstr("exclude"));
  EXPECT_THAT(message_of([](auto& j) { j["methods"][0]["steps"][0] = "render 'x"; }), HasSubstr("quote"));
  EXPECT_THAT(message_of([](auto& j) {
                j["methods"][0]["steps"] = {"sh a", "sh b"};
              }),
              HasSubstr("two steps"));
  EXPECT_THAT(message_of([](auto& j) { j["methods"][0]["steps"][0] = "render x{scene}"; }),
              HasSubstr("by itself"));
  EXPECT_THROW(parse_plan("{", "plan", commands), Error);
  EXPECT_THROW(parse_plan("[]", "plan", commands), Error);
}

TEST(Plan, VariablesAreSetByName) {
  Plan plan = parse(valid());
  set_variable(plan, "width=7");
  EXPECT_EQ(plan.variables[0].second, "7");
  EXPECT_THAT([&] { set_variable(plan, "with=7"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("\"width\"")));
  EXPECT_THROW(set_variable(plan, "width"), Error);
}

TEST(Plan, SchemaAndReaderAgree) {
  EXPECT_THAT(schema_errors(valid()), testing::IsEmpty());
  const std::vector<std::function<void(ordered_json&)>> bad = {
      [](auto& j) { j["titel"] = "x"; },
      [](auto& j) { j.erase("methods"); },
      [](auto& j) { j["block"] = 0; },
      [](auto& j) { j["layers"] = {"indirekt"}; },
      [](auto& j) { j["reference"]["picture"] = "x.exr"; },
      [](auto& j) { j["methods"][0]["parameters"]["depth"] = ordered_json::array(); },
      [](auto& j) { j["columns"][1]["better"] = "yes"; },
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    ordered_json json = valid();
    bad[i](json);
    EXPECT_THAT(schema_errors(json), testing::Not(testing::IsEmpty())) << i;
    EXPECT_THROW(parse(json), Error) << i;
  }
}

TEST(Plan, ShippedPlansAreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "plans")) {
    const std::string text = read_text_file(entry.path());
    EXPECT_THAT(schema_errors(ordered_json::parse(text)), testing::IsEmpty()) << entry.path();
    EXPECT_NO_THROW(parse_plan(text, entry.path().string(), commands));
    ++count;
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace ssphh::report
