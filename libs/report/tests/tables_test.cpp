#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "example_report.h"

namespace ssphh::report {
namespace {

using nlohmann::json;
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
  const json data = json::parse(report_json(example_report()));
  EXPECT_EQ(data["cells"][2]["values"]["render.seconds"]["median"], 4);
  EXPECT_EQ(data["cells"][2]["values"]["render.seconds"]["count"], 3);
  EXPECT_EQ(data["cells"][3]["failure"], "it failed </script>");
  const std::string methods[] = {"truth", "m", "m", "bad, \"quoted\""};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(data["cells"][i]["method"], methods[i]);
  EXPECT_EQ(data["cells"][2]["parameters"], json({{"n", "2"}}));
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
    add_numbers("s", json{{"list", std::vector<int>(length, 1)}}.dump(), values);
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
}

}  // namespace
}  // namespace ssphh::report
