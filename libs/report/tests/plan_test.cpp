#include <filesystem>
#include <functional>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/report/plan.h>

#include "json_schema.h"
#include "json_text.h"
#include "places.h"

namespace ssphh::report {
namespace {

const std::vector<std::string> commands = {"render", "bake", "hier", "truth", "sh", "measure"};

json::Value valid() {
  return test::parse_json(R"({
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

Plan parse(const json::Value& json) {
  return parse_plan(print(json), "plan", commands);
}

// The message of the Error that a changed plan gives.
std::string refusal_of(const std::function<void(json::Value&)>& change) {
  json::Value json = valid();
  change(json);
  try {
    parse(json);
  } catch (const Error& e) {
    return e.what();
  }
  return "accepted";
}

std::vector<std::string> schema_errors(const json::Value& json) {
  return test::schema_errors(test::source_dir() / "schemas/report-plan.schema.json", print(json));
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
  json::Value json = valid();
  json["published"]["rows"] = json::Value::array();
  json["methods"][0]["parameters"] = {{{"depth", 25}, {"n", "x"}}, {{"depth", 3}, {"n", "y"}}};
  const Plan plan = parse(json);
  ASSERT_EQ(plan.methods[0].variants.size(), 2u);
  EXPECT_EQ(label(plan.methods[0], plan.methods[0].variants[1]), "m, depth 3, n y");
}

TEST(Plan, UnknownNamesAreAnsweredWithTheNearest) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal_of([](auto& j) { j["titel"] = "x"; }),
              AllOf(HasSubstr("\"titel\""), HasSubstr("\"title\"")));
  EXPECT_THAT(refusal_of([](auto& j) { j["scenes"][0]["exposre"] = 1; }),
              AllOf(HasSubstr("scenes[0]"), HasSubstr("\"exposure\"")));
  EXPECT_THAT(refusal_of([](auto& j) { j["methods"][0]["repetition"] = 1; }), HasSubstr("\"repetitions\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["layers"] = {"indirekt"}; }), HasSubstr("\"indirect\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["methods"][0]["steps"][0] = "rendr {scene}"; }),
              HasSubstr("\"render\""));
  EXPECT_THAT(
      refusal_of([](auto& j) { j["methods"][0]["steps"][0] = "render {scene} --width {widht} -o p.exr"; }),
      HasSubstr("\"width\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["scenes"][0]["variables"]["sp"] = 1; }), HasSubstr("\"spp\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["published"]["rows"][0]["method"] = "m, depth 2, n a"; }),
              HasSubstr("did you mean \"m, depth 1, n a\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["columns"][1]["titel"] = 1; }), HasSubstr("\"title\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["published"]["sources"] = "me"; }), HasSubstr("\"source\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["published"]["rows"][0]["scenes"] = 1; }), HasSubstr("\"scene\""));
  EXPECT_THAT(refusal_of([](auto& j) { j["charts"][0]["titel"] = "x"; }), HasSubstr("\"title\""));
}

TEST(Plan, WrongValuesAreNamedWithTheirPlace) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal_of([](auto& j) { j.erase("scenes"); }), HasSubstr("\"scenes\" is missing"));
  EXPECT_THAT(refusal_of([](auto& j) { j["scenes"] = json::Value::array(); }), HasSubstr("plan: scenes"));
  EXPECT_THAT(refusal_of([](auto& j) { j["block"] = 0; }), HasSubstr("plan: block"));
  EXPECT_THAT(refusal_of([](auto& j) { j["block"] = 1.5; }),
              HasSubstr("1.5 must be an integer from 1 to 4096"));
  EXPECT_THAT(refusal_of([](auto& j) { j["methods"][0]["repetitions"] = 0; }), HasSubstr("repetitions"));
  EXPECT_THAT(refusal_of([](auto& j) {
                j["scenes"][0]["insets"][0]["at"] = {0, 0, 0, 1};
              }),
              HasSubstr("left < right"));
  EXPECT_THAT(refusal_of([](auto& j) { j["reference"]["picture"] = "x.exr"; }), HasSubstr("exclude"));
  EXPECT_THAT(refusal_of([](auto& j) { j["methods"][0]["steps"][0] = "render 'x"; }), HasSubstr("quote"));
  EXPECT_THAT(refusal_of([](auto& j) {
                j["methods"][0]["steps"] = {"sh a", "sh b"};
              }),
              HasSubstr("two steps"));
  EXPECT_THAT(refusal_of([](auto& j) { j["methods"][0]["steps"][0] = "render x{scene}"; }),
              HasSubstr("by itself"));
  EXPECT_THROW(parse_plan("{", "plan", commands), Error);
  EXPECT_THROW(parse_plan("[]", "plan", commands), Error);
}

TEST(Plan, WhatIsLeftOutHasItsDefault) {
  const Plan plan = parse_plan(R"({
    "scenes": [{"name": "s", "scene": "builtin:x"}], "reference": {"steps": ["truth {scene} -o t.exr"], "picture": "t.exr"},
    "methods": [{"name": "m", "steps": ["render {scene}"]}],
    "columns": ["flip", {"value": "mae"}], "charts": [{"x": "depth", "y": "relmse"}], "published": {}})",
                               "folder/plan.json", commands);
  EXPECT_EQ(plan.title, "folder/plan.json");
  EXPECT_EQ(plan.about, "");
  EXPECT_EQ(plan.block, 16);
  EXPECT_EQ(plan.time_limit, 3600);
  EXPECT_EQ(plan.published_source, "");
  EXPECT_TRUE(plan.variables.empty() && plan.layers.empty() && plan.published.empty());
  const PlanScene& scene = plan.scenes[0];
  EXPECT_EQ(scene.title, "s");
  EXPECT_EQ(scene.exposure, std::nullopt) << "what suits the picture";
  EXPECT_FALSE(scene.optional);
  EXPECT_TRUE(scene.variables.empty() && scene.insets.empty());
  EXPECT_EQ(plan.reference.name, "reference");
  EXPECT_EQ(plan.reference.title, "reference");
  EXPECT_EQ(plan.reference.repetitions, 1);
  const PlanMethod& method = plan.methods[0];
  EXPECT_EQ(method.title, "m");
  EXPECT_EQ(method.about, "");
  EXPECT_EQ(method.picture, "");
  EXPECT_EQ(method.variants, (std::vector<Parameters>{{}}));
  EXPECT_EQ(method.repetitions, 1);
  EXPECT_TRUE(method.scenes.empty() && method.halves.empty());
  for (std::size_t i = 0; i < 2; ++i) {
    const Column& column = plan.columns[i];
    EXPECT_EQ(column.value, i == 0 ? "flip" : "mae");
    EXPECT_EQ(column.title, column.value);
    EXPECT_EQ(column.unit, "");
    EXPECT_EQ(column.better, 0);
  }
  EXPECT_EQ(plan.charts[0].title, "relmse");
  EXPECT_FALSE(plan.charts[0].log_x || plan.charts[0].log_y);
  EXPECT_FALSE(
      parse_plan(
          R"({"scenes": [{"name": "s", "scene": "x"}], "methods": [{"name": "m", "steps": ["bake"]}]})", "p",
          commands)
          .has_reference);
}

TEST(Plan, EveryKeyGoesWhereItBelongs) {
  json::Value json = valid();
  json["about"] = "A";
  json["scenes"][0].update({{"title", "S"}, {"exposure", -1.5}, {"optional", true}});
  json["reference"].update({{"name", "r"}, {"title", "R"}, {"about", "of r"}});
  json["methods"][0].update({{"title", "M"}, {"about", "of m"}, {"scenes", "s"}});
  json["methods"][0]["steps"] = {{{"name", "first"}, {"run", "bake {scene} -o p.sphl"}},
                                 "render {scene} -o p.exr"};
  json["charts"][0].update({{"title", "C"}, {"log_x", true}});
  const Plan plan = parse(json);
  EXPECT_EQ(plan.about, "A");
  EXPECT_EQ(plan.time_limit, 60);
  EXPECT_EQ(plan.variables, (Parameters{{"width", "48"}, {"spp", "2"}}));
  EXPECT_EQ(plan.layers, std::vector<std::string>{"indirect"});
  const PlanScene& scene = plan.scenes[0];
  EXPECT_EQ(scene.title, "S");
  EXPECT_EQ(scene.exposure, -1.5);
  EXPECT_TRUE(scene.optional);
  const Inset& inset = scene.insets[0];
  EXPECT_EQ(inset.name, "i");
  EXPECT_EQ((std::vector<double>{inset.x0, inset.y0, inset.x1, inset.y1}),
            (std::vector<double>{0, 0.25, 0.5, 1}));
  EXPECT_EQ(plan.reference.name, "r");
  EXPECT_EQ(plan.reference.title, "R");
  EXPECT_EQ(plan.reference.about, "of r");
  EXPECT_THAT(plan.reference.halves, testing::ElementsAre("truth.a.exr", "truth.b.exr"));
  const PlanMethod& method = plan.methods[0];
  EXPECT_EQ(method.title, "M");
  EXPECT_EQ(method.about, "of m");
  EXPECT_EQ(method.picture, "p.exr");
  EXPECT_THAT(method.scenes, testing::ElementsAre("s")) << "one text is a list of one";
  EXPECT_EQ(method.steps[0].name, "first");
  EXPECT_EQ(method.steps[1].name, "render");
  EXPECT_EQ(plan.columns[0].value, "flip");
  EXPECT_EQ(plan.columns[1].value, "render.seconds");
  EXPECT_EQ(plan.columns[1].title, "R");
  EXPECT_EQ(plan.columns[1].unit, "s");
  const Chart& chart = plan.charts[0];
  EXPECT_EQ(chart.title, "C");
  EXPECT_EQ(chart.x, "depth");
  EXPECT_EQ(chart.y, "relmse");
  EXPECT_TRUE(chart.log_x);
  EXPECT_EQ(plan.published_source, "me");
  EXPECT_EQ(plan.published[0].scene, "s");
  EXPECT_EQ(plan.published[0].method, "m, depth 1, n a");
  json["columns"][1]["better"] = "more";
  json["charts"][0]["log_x"] = false;
  EXPECT_EQ(parse(json).columns[1].better, 1);
  EXPECT_FALSE(parse(json).charts[0].log_x);
}

TEST(Plan, NumbersHaveLimits) {
  const auto accepted = [](const std::function<void(json::Value&)>& change) {
    const std::string message = refusal_of(change);
    EXPECT_TRUE(message == "accepted" || message.find(" must be ") != std::string::npos) << message;
    return message == "accepted";
  };
  const auto expect_range = [&](const std::function<json::Value&(json::Value&)>& at, const json::Value& low,
                                const json::Value& high, const json::Value& step) {
    for (const auto& [value, good] :
         std::vector<std::pair<double, bool>>{{low.number(), true},
                                              {high.number(), true},
                                              {low.number() - step.number(), false},
                                              {high.number() + step.number(), false}})
      EXPECT_EQ(accepted([&, value = value](auto& j) {
                  if (step.is_integer())
                    at(j) = static_cast<int>(value);
                  else
                    at(j) = value;
                }),
                good)
          << value;
  };
  expect_range([](auto& j) -> json::Value& { return j["block"]; }, 1, 4096, 1);
  expect_range([](auto& j) -> json::Value& { return j["time_limit"]; }, 1, 1000000, 1);
  expect_range([](auto& j) -> json::Value& { return j["methods"][0]["repetitions"]; }, 1, 1000, 1);
  expect_range([](auto& j) -> json::Value& { return j["scenes"][0]["exposure"]; }, -30, 30, 0.25);
}

TEST(Plan, AnExposureMayBeLeftToThePicture) {
  const Plan plan = parse_plan(R"({"scenes": [{"name": "s", "scene": "x", "exposure": "auto"}],
    "methods": [{"name": "m", "steps": ["render {scene} -o o.exr"], "picture": "o.exr"}]})",
                               "p", {"render"});
  EXPECT_EQ(plan.scenes[0].exposure, std::nullopt);
}

TEST(Plan, AnInsetLiesWithinThePicture) {
  const auto at = [](const json::Value& value) {
    return refusal_of([&](auto& j) { j["scenes"][0]["insets"][0]["at"] = value; });
  };
  EXPECT_EQ(at({0, 0, 1, 1}), "accepted");
  for (const std::vector<double>& bad : std::vector<std::vector<double>>{{-0.01, 0, 1, 1},
                                                                         {0, -0.01, 1, 1},
                                                                         {0, 0, 1.01, 1},
                                                                         {0, 0, 1, 1.01},
                                                                         {0.5, 0, 0.5, 1},
                                                                         {0, 0.5, 1, 0.5},
                                                                         {0.6, 0, 0.4, 1},
                                                                         {0, 0.6, 1, 0.4}})
    EXPECT_THAT(at(bad), testing::HasSubstr("insets[0].at: must be left < right and top < bottom"));
  EXPECT_THAT(at({0, 0, 1}), testing::HasSubstr("insets[0].at"));
  EXPECT_THAT(at({0, 0, 1, "1"}), testing::HasSubstr("insets[0].at"));
  EXPECT_THAT(refusal_of([](auto& j) { j["scenes"][0]["insets"][0]["mask"] = "m.png"; }),
              testing::HasSubstr("exclude each other"));
  EXPECT_EQ(refusal_of([](auto& j) {
              j["scenes"][0]["insets"][0] = {{"name", "i"}, {"mask", "m.png"}};
            }),
            "accepted");
}

TEST(Plan, AsksAnHourOfACommandAndBlocksOf16PixelsUnlessItSaysOtherwise) {
  EXPECT_EQ(Plan().time_limit, 3600);
  EXPECT_EQ(Plan().block, 16);
}

TEST(Plan, WrongKindsAndDoublesAreNamed) {
  using testing::HasSubstr;
  const auto expect = [](const char* message, const std::function<void(json::Value&)>& change) {
    EXPECT_THAT(refusal_of(change), HasSubstr(message));
  };
  expect("plan: must be an object", [](auto& j) { j = json::Value::array(); });
  expect("plan: title: must be a string", [](auto& j) { j["title"] = 7; });
  expect("plan: block: must be a number", [](auto& j) { j["block"] = "8"; });
  expect("scenes[0].exposure: must be a number", [](auto& j) { j["scenes"][0]["exposure"] = "1"; });
  expect("scenes[0].optional: must be true or false", [](auto& j) { j["scenes"][0]["optional"] = 1; });
  expect("plan: scenes: must be an array", [](auto& j) { j["scenes"] = "s"; });
  expect("plan: layers[0]: must be a string", [](auto& j) { j["layers"] = {1}; });
  expect("plan: variables: must be an object", [](auto& j) { j["variables"] = 1; });
  expect("plan: variables.width: must be a number or text", [](auto& j) { j["variables"]["width"] = true; });
  expect("scenes[0].scene: is empty", [](auto& j) { j["scenes"][0]["scene"] = " "; });
  expect("methods: is empty", [](auto& j) { j["methods"] = json::Value::array(), j.erase("published"); });
  expect("methods[0].steps: is empty", [](auto& j) { j["methods"][0]["steps"] = json::Value::array(); });
  expect("methods[0].steps[0]: is empty", [](auto& j) { j["methods"][0]["steps"][0] = ""; });
  expect("plan: methods[0].steps[0]: \"run\" is missing", [](auto& j) {
    j["methods"][0]["steps"][0] = {{"name", "x"}};
  });
  expect("plan: methods[0]: \"name\" is missing", [](auto& j) { j["methods"][0].erase("name"); });
  expect("plan: methods[0]: \"steps\" is missing", [](auto& j) { j["methods"][0].erase("steps"); });
  expect("plan: scenes[0]: \"scene\" is missing", [](auto& j) { j["scenes"][0].erase("scene"); });
  expect("plan: columns[1]: \"value\" is missing", [](auto& j) { j["columns"][1].erase("value"); });
  expect("plan: charts[0]: \"y\" is missing", [](auto& j) { j["charts"][0].erase("y"); });
  expect("\"picture\" or \"halves\" is missing", [](auto& j) { j["reference"].erase("halves"); });
  expect("unknown member \"repetitions\"", [](auto& j) { j["reference"]["repetitions"] = 2; });
  expect("halves: must be two pictures", [](auto& j) { j["reference"]["halves"] = {"a.exr"}; });
  expect("better: must be less, more or none", [](auto& j) { j["columns"][1]["better"] = "yes"; });
  expect("values.R: must be a number", [](auto& j) { j["published"]["rows"][0]["values"]["R"] = "x"; });
  expect("unknown scene \"t\"", [](auto& j) { j["published"]["rows"][0]["scene"] = "t"; });
  expect("methods[0]: unknown scene \"t\" (known: s)", [](auto& j) { j["methods"][0]["scenes"] = {"t"}; });
  expect("two scenes are called \"s\"", [](auto& j) { j["scenes"].push_back(j["scenes"][0]); });
  expect("scenes[0].name: is empty", [](auto& j) { j["scenes"][0]["name"] = ""; });
  expect("methods[1]: two methods are called \"m, depth 1, n a\"",
         [](auto& j) { j["methods"].push_back(j["methods"][0]); });
  expect("parameters.depth: must be a list of values",
         [](auto& j) { j["methods"][0]["parameters"]["depth"] = 1; });
  expect("parameters: must be an object of lists or a list",
         [](auto& j) { j["methods"][0]["parameters"] = 1; });
  expect("parameters: is empty", [](auto& j) { j["methods"][0]["parameters"] = json::Value::array(); });
  expect("plan: reference: unknown name {n} in \"truth '{n}'\"",
         [](auto& j) { j["reference"]["steps"] = {"truth {n}"}; });
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
  const std::vector<std::function<void(json::Value&)>> bad = {
      [](auto& j) { j["titel"] = "x"; },
      [](auto& j) { j.erase("methods"); },
      [](auto& j) { j["block"] = 0; },
      [](auto& j) { j["layers"] = {"indirekt"}; },
      [](auto& j) { j["reference"]["picture"] = "x.exr"; },
      [](auto& j) { j["methods"][0]["parameters"]["depth"] = json::Value::array(); },
      [](auto& j) { j["columns"][1]["better"] = "yes"; },
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    json::Value json = valid();
    bad[i](json);
    EXPECT_THAT(schema_errors(json), testing::Not(testing::IsEmpty())) << i;
    EXPECT_THROW(parse(json), Error) << i;
  }
}

TEST(Plan, ShippedPlansAreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "plans")) {
    const std::string text = read_text_file(entry.path());
    EXPECT_THAT(schema_errors(test::parse_json(text)), testing::IsEmpty()) << entry.path();
    EXPECT_NO_THROW(parse_plan(text, entry.path().string(), commands));
    ++count;
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace ssphh::report
