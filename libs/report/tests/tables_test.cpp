#include <sstream>

#include <gmock/gmock.h>

#include "example_report.h"
#include "json_text.h"

namespace ssphh::report {
namespace {

using ssphh::test::parse_json;
using test::example_report;
using testing::HasSubstr;

// RFC 4180, as a spreadsheet reads it.
std::vector<std::vector<std::string>> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '"' && text[i + 1] == '"') {
        rows.back().back() += text[++i];
      } else if (c == '"') {
        quoted = false;
      } else {
        rows.back().back() += c;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      rows.back().emplace_back();
    } else if (c == '\r') {
      if (i + 2 < text.size()) rows.push_back({""});
      ++i;
    } else {
      rows.back().back() += c;
    }
  }
  return rows;
}

TEST(Tables, CsvHoldsEveryValueOfEveryCell) {
  const Report report = example_report();
  const auto rows = read_csv(report_csv(report));
  ASSERT_EQ(rows.size(), 5u);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(rows[4][2], "bad, \"quoted\"");
  EXPECT_EQ(rows[4][3], "1");
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
  };
  ASSERT_LT(column("flip"), rows[0].size());
  EXPECT_EQ(std::stod(rows[2][column("flip")]), report.cells[1].values.at("flip").mean);
  EXPECT_EQ(rows[3][column("parameter n")], "2");
  EXPECT_EQ(rows[2][column("render.seconds")], "2") << "the median of times";
}

TEST(Tables, JsonHoldsNumbersAndWhereTheyCameFrom) {
  const json::Value data = parse_json(report_json(example_report()));
  EXPECT_EQ(data["cells"][2]["values"]["render.seconds"]["median"], 4);
  EXPECT_EQ(data["cells"][2]["values"]["render.seconds"]["count"], 3);
  EXPECT_EQ(data["cells"][3]["failure"], "it failed </script>");
  const std::string methods[] = {"truth", "m", "m", "bad, \"quoted\""};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(data["cells"][i]["method"], methods[i]);
  EXPECT_EQ(data["cells"][2]["parameters"], json::Value({{"n", "2"}}));
  EXPECT_EQ(data["cells"][1]["steps"][0]["command"], "render 'a b' -o o.exr");
  EXPECT_EQ(data["scenes"][0]["hash"], "hash");
  EXPECT_EQ(identity_of(report_json(example_report())), "id");
  EXPECT_EQ(identity_of("nonsense"), "");
}

TEST(Tables, MarkdownShowsValuesBesidePublishedOnes) {
  const std::string text = report_markdown(example_report());
  EXPECT_THAT(text, HasSubstr("| method | FLIP | run [s] |"));
  EXPECT_THAT(text, HasSubstr("4 ± 5.3 (99)"));  // 2 4 12: median 4, deviation √28
  EXPECT_THAT(text, testing::ContainsRegex("m, n 1 \\| [0-9.]+ \\|"))
      << "a value of one run has no deviation";
  EXPECT_THAT(text, HasSubstr("(failed) |  |  |"));
  EXPECT_THAT(text, HasSubstr("Failed: s, bad"));
  EXPECT_THAT(text, HasSubstr("`ssphh render 'a b' -o o.exr`: 2.00 s, 5 MiB"));
}

/// Two scenes, the first with a reference, a method in two runs and one that failed; published numbers.
Report whole_report() {
  Report report;
  Plan& plan = report.plan;
  plan.title = "Title", plan.about = "About it.", plan.published_source = "a paper";
  plan.variables = {{"w", "4"}};
  plan.scenes.resize(3);
  plan.scenes[0].name = "s", plan.scenes[0].title = "Scene S", plan.scenes[0].exposure = 1.5;
  plan.scenes[0].insets = {{"corner", 0, 0.25, 0.5, 1}};
  plan.scenes[1].name = "t", plan.scenes[1].title = "Scene T";
  plan.scenes[2].name = "u", plan.scenes[2].title = "left out";
  plan.reference.name = "truth", plan.reference.title = "Truth", plan.reference.about = "of truth";
  plan.methods.resize(1);
  plan.methods[0].name = "m", plan.methods[0].title = "M", plan.methods[0].about = "of m";
  plan.methods[0].repetitions = 2;
  plan.layers = {"direct"}, plan.block = 8;
  plan.columns = {{"mae", "MAE | abs", "", -1}, {"a.seconds", "time", "s", 0}};
  plan.charts = {{"C", "x", "y", true, false}};
  plan.published = {{"s", "m, n 1", {{"time", 9.5}}}};
  report.notes = {"a note"};
  report.provenance = {"id", "1.0", "b", "abc", "a machine", "today", "ssphh report p", {{"s", "hash of s"}}};
  ReportCell reference{0, -1, "truth", {}, {}, {{"mae", {0, 0, 0, 1}}}, {}, {}};
  ReportCell m{0, 0, "m, n 1", {{"n", "1"}}, {}, {}, {}, {}};
  m.values["mae"] = {0.123456, 0.2, 0.0015, 2};
  m.values["a.seconds"] = {7, 6, 1.25, 2};
  m.steps.push_back({"a", "k1", "render x", "then", "here", 1, 1.504, (3u << 20) + 5});
  m.steps.push_back({"b", "k2", "bake y", "later", "there", 0, 2, 1u << 20});
  ReportCell again{1,  0, "m, n 2", {{"n", "2"}}, "line 1\nline 2", {{"mae", {-INFINITY, NAN, NAN, 1}}},
                   {}, {}};
  again.steps.push_back(m.steps[0]);
  report.cells = {reference, m, again};
  return report;
}

TEST(Tables, ASceneIsShownAsSuitsItsReferenceUnlessThePlanSays) {
  Report report = whole_report();
  const CellPicture picture{"", "", {}};
  report.cells[0].exposure = -7.5, report.cells[1].exposure = -6;
  EXPECT_EQ(exposure_of(report, 0), 1.5) << "the plan's";
  report.plan.scenes[0].exposure.reset();
  EXPECT_EQ(exposure_of(report, 0), 0) << "no cell has a picture";
  report.cells[1].pictures = {picture};
  EXPECT_EQ(exposure_of(report, 0), -6);
  report.cells[0].pictures = {picture};
  EXPECT_EQ(exposure_of(report, 0), -7.5);
  std::swap(report.cells[0], report.cells[1]);
  EXPECT_EQ(exposure_of(report, 0), -7.5) << "wherever the reference stands";
  EXPECT_EQ(exposure_of(report, 1), 0);
}

TEST(Tables, MarkdownAsAWhole) {
  EXPECT_EQ(
      report_markdown(whole_report()),
      "# Title\n\nAbout it.\n\n`ssphh report p`, a machine, ssphh 1.0 (abc).\nIn parentheses: a paper.\n"
      "\n* a note\n"
      "\n## Scene S\n\n| method | MAE \\| abs | time [s] |\n|---|---:|---:|\n"
      "| truth | 0 |  |\n| m, n 1 | 0.1235 ± 0.0015 | 6 ± 1.2 (9.5) |\n"
      "\n## Scene T\n\n| method | MAE \\| abs | time [s] |\n|---|---:|---:|\n| m, n 2 (failed) | −∞ |  |\n"
      "\n## Failed: t, m, n 2\n\n    line 1\n    line 2\n"
      "\n## Commands\n\n* `ssphh render x`: 1.50 s, 3 MiB, then\n* `ssphh bake y`: 2.00 s, 1 MiB, later\n");
  Report bare = whole_report();
  bare.plan.about.clear(), bare.plan.published_source.clear(), bare.provenance.commit.clear();
  bare.notes.clear(), bare.cells.clear();
  EXPECT_EQ(report_markdown(bare), "# Title\n\n`ssphh report p`, a machine, ssphh 1.0.\n\n## Commands\n\n");
}

TEST(Tables, CsvAsAWhole) {
  Report report = whole_report();
  report.cells[1].label = "a \"b\",\nc";
  EXPECT_EQ(report_csv(report),
            "scene,method,label,failed,runs,parameter n,a.seconds,a.seconds deviation,mae,mae deviation\r\n"
            "s,truth,truth,0,1,,,,0,\r\n"
            "s,m,\"a \"\"b\"\",\nc\",0,2,1,6,1.25,0.123456,0.0015\r\n"
            "t,m,\"m, n 2\",1,2,2,,,,\r\n");
}

TEST(Tables, JsonAsAWhole) {
  const json::Value data = parse_json(report_json(whole_report()));
  EXPECT_EQ(data["title"], "Title");
  EXPECT_EQ(data["about"], "About it.");
  EXPECT_EQ(data["provenance"],
            parse_json(R"({"identity": "id", "version": "1.0", "build": "b", "commit": "abc",
      "machine": "a machine", "created": "today", "command": "ssphh report p"})"));
  EXPECT_EQ(data["notes"], json::Value::array({"a note"}));
  EXPECT_EQ(data["variables"], json::Value({{"w", "4"}}));
  EXPECT_EQ(data["block"], 8);
  EXPECT_EQ(data["layers"], json::Value::array({"direct"}));
  EXPECT_EQ(data["scenes"][0], parse_json(R"({"name": "s", "title": "Scene S", "exposure": 1.5,
      "insets": [{"name": "corner", "at": [0, 0.25, 0.5, 1]}], "hash": "hash of s"})"));
  EXPECT_EQ(data["scenes"][1]["exposure"], 0) << "no picture";
  EXPECT_EQ(data["scenes"][1]["hash"], json::Value());
  EXPECT_EQ(data["columns"], parse_json(R"([{"value": "mae", "title": "MAE | abs", "unit": "", "better": -1},
      {"value": "a.seconds", "title": "time", "unit": "s", "better": 0}])"));
  EXPECT_EQ(data["charts"],
            parse_json(R"([{"title": "C", "x": "x", "y": "y", "log_x": true, "log_y": false}])"));
  EXPECT_EQ(
      data["published"],
      parse_json(
          R"({"source": "a paper", "rows": [{"scene": "s", "method": "m, n 1", "values": {"time": 9.5}}]})"));
  EXPECT_EQ(data["cells"].size(), 3u);
  EXPECT_EQ(data["cells"][0]["reference"], true);
  EXPECT_EQ(data["cells"][0]["title"], "Truth");
  EXPECT_EQ(data["cells"][0]["about"], "of truth");
  EXPECT_EQ(data["cells"][1], parse_json(R"({"scene": "s", "method": "m", "title": "M", "about": "of m",
      "label": "m, n 1", "reference": false, "parameters": {"n": "1"}, "failure": null,
      "values": {"a.seconds": {"mean": 7, "median": 6, "deviation": 1.25, "count": 2},
                 "mae": {"mean": 0.123456, "median": 0.2, "deviation": 0.0015, "count": 2}},
      "steps": [{"name": "a", "repetition": 1, "command": "render x", "key": "k1", "seconds": 1.504,
                 "peak_bytes": 3145733, "started": "then", "machine": "here"},
                {"name": "b", "repetition": 0, "command": "bake y", "key": "k2", "seconds": 2,
                 "peak_bytes": 1048576, "started": "later", "machine": "there"}]})"));
  EXPECT_EQ(data["cells"][2]["scene"], "t");
  EXPECT_EQ(data["cells"][2]["failure"], "line 1\nline 2");
  EXPECT_EQ(data["cells"][2]["values"]["mae"],
            parse_json(R"({"mean": null, "median": null, "deviation": null, "count": 1})"));
}

TEST(Tables, APlanWithoutColumnsShowsTheUsualOnes) {
  Report report;
  const auto names = [&] {
    std::string text;
    for (const Column& c : columns_of(report))
      text += c.value + "/" + c.title + "/" + c.unit + "/" + std::to_string(c.better) + " ";
    return text;
  };
  EXPECT_EQ(names(), "seconds/seconds/s/-1 ");
  report.plan.has_reference = true;
  EXPECT_EQ(names(),
            "mean_ratio/mean ratio//0 mae/MAE//-1 relmse/relMSE//-1 "
            "relmse_method/relMSE − reference's noise//-1 flip/FLIP//-1 ssim/SSIM//1 seconds/run/s/-1 ");
  report.plan.columns = {{"x", "X", "", 0}};
  EXPECT_EQ(names(), "x/X//0 ");
}

TEST(Values, ParametersAreShownWhereTheyAreNumbers) {
  ReportCell cell{0, 0, "m", {{"n", "2.5"}, {"word", "x"}, {"half", "3px"}}, {}, {}, {}, {}};
  cell.values["n2"] = {4, 5, 0, 1}, cell.values["seconds"] = {4, 5, 0, 1};
  cell.values["render.cpu_seconds"] = {4, 5, 0, 1}, cell.values["seconds_total"] = {4, 5, 0, 1};
  EXPECT_EQ(shown(cell, "n"), 2.5);
  EXPECT_EQ(shown(cell, "n2"), 4);
  EXPECT_EQ(shown(cell, "seconds"), 5);
  EXPECT_EQ(shown(cell, "render.cpu_seconds"), 5);
  EXPECT_EQ(shown(cell, "seconds_total"), 4);
  for (const char* none : {"word", "half", "other"}) EXPECT_TRUE(std::isnan(shown(cell, none))) << none;
}

TEST(Values, NumbersOfAResultAreNamedByTheirPath) {
  std::map<std::string, std::vector<double>> values;
  add_numbers("bake", R"({"a": 1, "b": {"c": 2.5}, "d": "text", "e": [{"x": 1}, 2], "f": true, "g": null})",
              values);
  EXPECT_THAT(values, testing::ElementsAre(testing::Pair("bake.a", testing::ElementsAre(1)),
                                           testing::Pair("bake.b.c", testing::ElementsAre(2.5)),
                                           testing::Pair("bake.e.0.x", testing::ElementsAre(1)),
                                           testing::Pair("bake.e.1", testing::ElementsAre(2)),
                                           testing::Pair("bake.f", testing::ElementsAre(1))));
  add_numbers("bake", "no json", values);
  EXPECT_EQ(values.size(), 5u);
}

TEST(Values, OfAListOfSixteenEachIsAValueAndOfALongerOneNone) {
  const auto count = [](std::size_t length) {
    std::map<std::string, std::vector<double>> values;
    add_numbers("s", print(json::Value{{"list", std::vector<int>(length, 1)}}), values);
    return values.size();
  };
  EXPECT_EQ(count(16), 16u);
  EXPECT_EQ(count(17), 0u);
}

TEST(Values, MedianAndDeviation) {
  const Value even = value_of({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(even.median, 2.5);
  EXPECT_DOUBLE_EQ(even.mean, 2.5);
  EXPECT_DOUBLE_EQ(even.deviation, std::sqrt(5.0 / 3));
  EXPECT_EQ(value_of({}).count, 0);
  const Value odd = value_of({9, 1, 2});
  EXPECT_EQ(odd.median, 2);
  EXPECT_DOUBLE_EQ(odd.mean, 4);
  EXPECT_EQ(odd.count, 3);
  EXPECT_EQ(value_of({5}).deviation, 0);
  EXPECT_EQ(value_of({5}).median, 5);
  EXPECT_TRUE(std::isnan(value_of({1, NAN, 2}).median));
}

}  // namespace
}  // namespace ssphh::report
