// What is said of mistakes in a plan, in a method's pictures and in a cache, in full.

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/report/cache.h>
#include <ssphh/report/expansion.h>
#include <ssphh/report/measure.h>
#include <ssphh/report/plan.h>

#include "error_message.h"
#include "expected_text.h"
#include "json_text.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::report {
namespace {

using test::message_of;

json::Value plan_with(const std::string& member, const std::string& value) {
  json::Value plan = test::parse_json(R"({
    "variables": {"width": 48, "spp": 2},
    "scenes": [{"name": "room", "scene": "builtin:box"}],
    "reference": {"steps": ["truth {scene} -o truth.exr"], "picture": "truth.exr"},
    "methods": [{"name": "paths", "steps": ["render {scene} --spp {spp} -o p.exr"], "picture": "p.exr"}]
  })");
  if (!member.empty()) plan[member.c_str()] = test::parse_json(value);
  return plan;
}

std::string said_of(const std::string& member, const std::string& value) {
  return message_of([&] {
    parse_plan(print(plan_with(member, value)), "plan", {"render", "truth", "bake"});
  });
}

TEST(Messages, OfPlans) {
  EXPECT_EQ(said_of("", ""), "no error");
  std::string said;
  const auto with = [&](const char* member, const std::string& value) {
    said += fmt::format("{} {}\n  {}\n", member, value, said_of(member, value));
  };
  with("titel", "1");
  with("scenes", "[]");
  with("scenes", R"([{"name": "", "scene": "builtin:box"}])");
  with("scenes", R"([{"name": "a", "scene": "x"}, {"name": "a", "scene": "y"}])");
  with("scenes", R"([{"name": "a", "scene": " "}])");
  with("scenes", R"([{"name": "a", "scene": "x 'y"}])");
  with("scenes", R"([{"name": "a", "scene": "x", "exposure": 31}])");
  with("scenes", R"([{"name": "a", "scene": "x", "variables": {"widht": 1}}])");
  with("scenes", R"([{"name": "a", "scene": "x", "variables": {"width": []}}])");
  for (const char* inset : {"{}", R"({"at": [0, 0, 1, 1], "mask": "m.png"})", R"({"at": [0, 0, 1]})",
                            R"({"at": [0, 0, 0, 1]})", R"({"at": [0, 0, 1, 1.5]})", R"({"At": []})"})
    with("scenes", fmt::format(R"([{{"name": "a", "scene": "x", "insets": [{}]}}])", inset));
  with("layers", R"(["indirekt"])");
  with("columns", R"([{"value": "flip", "better": "most"}])");
  with("block", "0");
  with("block", "4097");
  with("time_limit", "0");
  with("time_limit", "1000001");
  with("reference", R"({"steps": ["truth {scene} -o a.exr"]})");
  with("reference", R"({"steps": ["truth -o a.exr"], "picture": "a.exr", "repetitions": 2})");
  const auto method = [&](const std::string& members) {
    with("methods", fmt::format(R"([{{"name": "m", {}}}])", members));
  };
  with("methods", "[]");
  method(R"("steps": [])");
  method(R"("steps": [""])");
  method(R"("steps": ["rendr {scene}"])");
  method(R"("steps": ["render a", "render b"])");
  method(R"("steps": ["render {scene"])");
  method(R"("steps": ["render x{scene}"])");
  method(R"("steps": ["render --width {widht}"])");
  method(R"("steps": ["render a"], "halves": ["a.exr"])");
  method(R"("steps": ["render a"], "halves": ["a.exr", "b.exr"], "picture": "a.exr")");
  method(R"("steps": ["render a"], "parameters": 1)");
  method(R"("steps": ["render a"], "parameters": [])");
  method(R"("steps": ["render a"], "parameters": {"a": []})");
  method(R"("steps": ["render a"], "parameters": {"a": [null]})");
  method(R"("steps": ["render a"], "repetitions": 0)");
  method(R"("steps": ["render a"], "repetitions": 1001)");
  method(R"("steps": ["render a"], "scenes": ["rom"])");
  with("methods", R"([{"name": "m", "steps": ["render a"]}, {"name": "m", "steps": ["render b"]}])");
  with("published", R"({"rows": [{"scene": "rom", "method": "paths", "values": {"R": 1}}]})");
  with("published", R"({"rows": [{"scene": "room", "method": "path", "values": {"R": 1}}]})");
  with("published", R"({"rows": [{"scene": "room", "method": "paths", "values": {"R": "1"}}]})");
  test::expect_text_of("libs/report/tests/expected/messages.txt", said);
}

TEST(Messages, OfVariables) {
  Plan plan = parse_plan(print(plan_with("", "")), "plan", {"render", "truth"});
  EXPECT_EQ(message_of([&] { set_variable(plan, "width"); }), "--set width: is not NAME=VALUE");
  EXPECT_EQ(message_of([&] { set_variable(plan, "widht=1"); }),
            "--set widht=1: the plan has no variable \"widht\" (did you mean \"width\"?)");
  set_variable(plan, "width=a=b");
  EXPECT_EQ(plan.variables, (Parameters{{"width", "a=b"}, {"spp", "2"}}));
}

TEST(Messages, OfPicturesThatNoStepWrites) {
  const auto said = [](const char* method) {
    const Plan plan =
        parse_plan(print(plan_with("methods", fmt::format("[{}]", method))), "plan", {"render", "truth"});
    const ExpandContext context{.folder = {}, .version = "1", .scene_hashes = {{"room", "h"}}};
    return message_of([&] { expand(plan, context); });
  };
  EXPECT_EQ(said(R"({"name": "m", "steps": ["render {scene} -o p.exr"], "picture": "p.png"})"),
            "method m: no step writes \"p.png\" (a picture is the name after a step's -o)");
  for (const char* name : {"a/p.exr", ".", "..", "''"}) {
    EXPECT_EQ(
        said(fmt::format(R"({{"name": "m", "steps": ["render {{scene}} -o {}"]}})", name).c_str()),
        fmt::format("step render: output \"{}\" must be a bare name (every run has a folder of its own)",
                    std::string_view(name) == "''" ? "" : name));
  }
}

class LayerFiles : public testing::Test {
 protected:
  void write(const std::string& name, int width, int height, int channels = 3) const {
    image::Image image(width, height, channels);
    std::ranges::fill(image.pixels, 0.5f);
    image::write_image(dir_ / name, image);
  }
  std::string said(const std::vector<std::string>& names, const std::string& layer) const {
    std::vector<std::filesystem::path> files;
    for (const std::string& name : names) files.push_back(dir_.path() / name);
    std::string text = message_of([&] { load_layer(files, layer); });
    const std::string folder = dir_.path().string() + "/";
    return text.starts_with(folder) ? text.substr(folder.size()) : text;
  }
  const test::TempDir dir_{test::memory_dir()};
};

TEST_F(LayerFiles, AreOfOneSize) {
  write("a.exr", 4, 2), write("b.exr", 4, 2), write("wide.exr", 5, 2), write("high.exr", 4, 3);
  EXPECT_EQ(said({"a.exr", "b.exr"}, ""), "no error");
  EXPECT_EQ(said({"a.exr", "wide.exr"}, ""), "wide.exr: the two halves differ in size");
  EXPECT_EQ(said({"a.exr", "high.exr"}, ""), "high.exr: the two halves differ in size");
  EXPECT_EQ(said({}, ""), "layer: there is no picture");
  const std::string differ = "a.exr: indirect light and albedo must be in colour and of one size";
  write("a.indirect.exr", 4, 2), write("a.albedo.exr", 4, 2);
  EXPECT_EQ(said({"a.exr"}, "irradiance"), "no error");
  write("a.albedo.exr", 5, 2);
  EXPECT_EQ(said({"a.exr"}, "irradiance"), differ);
  write("a.albedo.exr", 4, 3);
  EXPECT_EQ(said({"a.exr"}, "irradiance"), differ);
  write("a.albedo.exr", 4, 2), write("a.indirect.exr", 4, 2, 1);
  EXPECT_EQ(said({"a.exr"}, "irradiance"), differ);
}

TEST(Messages, OfMeasures) {
  image::Image a(4, 2), wide(5, 2);
  const auto said = [](const LayerPicture& reference, const std::vector<LayerPicture>& runs,
                       const Inset& inset = {}) {
    MeasureParams params;
    params.insets = {inset};
    return message_of([&] { measure_layer(reference, runs, params); });
  };
  Inset whole;
  whole.name = "all", whole.x0 = 0, whole.y0 = 0, whole.x1 = 1, whole.y1 = 1;
  EXPECT_EQ(said({a, {}}, {{a, {}}}, whole), "no error");
  EXPECT_EQ(said({a, {}}, {}, whole), "layer: there is no run to measure");
  EXPECT_EQ(said({a, wide}, {{a, {}}}, whole), "layer: the variance is not of the picture's size");
  EXPECT_EQ(said({a, {}}, {{a, wide}}, whole), "layer: the variance is not of the picture's size");
  const std::string differ = "layer: sizes differ between the runs and the reference";
  EXPECT_EQ(said({a, {}}, {{wide, {}}}, whole), differ);
  EXPECT_EQ(said({a, {}}, {{a, {}}, {a, a}}, whole), differ);
  const auto of_inset = [&](double Inset::*edge, double value) {
    Inset inset = whole;
    inset.*edge = value;
    return said({a, {}}, {{a, {}}}, inset);
  };
  const std::string bounds = "inset all: must be left < right and top < bottom, all within 0..1";
  EXPECT_EQ(of_inset(&Inset::x0, -0.01), bounds);
  EXPECT_EQ(of_inset(&Inset::x0, 1), bounds);
  EXPECT_EQ(of_inset(&Inset::x1, 1.01), bounds);
  EXPECT_EQ(of_inset(&Inset::y0, -0.01), bounds);
  EXPECT_EQ(of_inset(&Inset::y0, 1), bounds);
  EXPECT_EQ(of_inset(&Inset::y1, 1.01), bounds);
}

}  // namespace
}  // namespace ssphh::report
