// Messages as programs and terminals read them.

#include <sstream>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "results/stderr_log.h"
#include "temp_dir.h"
#include "tool_checks.h"
#include "variable.h"

namespace ssphh::app {
namespace {

using test::Variable;

TEST(Log, AJsonLineHoldsTimeLevelAndMessage) {
  const std::chrono::system_clock::time_point time(std::chrono::milliseconds(1'795'000'000'042));
  EXPECT_EQ(json_line(LogLevel::warning, "two\nlines, \"quoted\"", time),
            R"({"time":"2026-11-18T11:06:40.042Z","level":"warning","message":"two\nlines, \"quoted\""})");
}

TEST(Log, ColourMarksWhatIsNoNews) {
  EXPECT_EQ(coloured_line(LogLevel::error, "dark"), "\x1b[1;31merror:\x1b[0m dark");
  EXPECT_EQ(coloured_line(LogLevel::warning, "dim"), "\x1b[1;33mwarning:\x1b[0m dim");
  EXPECT_EQ(coloured_line(LogLevel::info, "lit"), "lit");
}

TEST(Log, ColourIsForTerminalsWhoseUserDoesNotRefuseIt) {
  const Variable term("TERM", "xterm"), none("NO_COLOR", nullptr);
  EXPECT_TRUE(wants_colour(true));
  EXPECT_FALSE(wants_colour(false));
  {
    const Variable empty("NO_COLOR", "");
    EXPECT_TRUE(wants_colour(true)) << "no-color.org: present and not empty";
    const Variable set("NO_COLOR", "1");
    EXPECT_FALSE(wants_colour(true));
  }
  const Variable dumb("TERM", "dumb");
  EXPECT_FALSE(wants_colour(true));
}

TEST(Log, WithLogJsonAllOfStderrIsObjects) {
  const test::TempDir dir;
  const auto levels_of = [](const test::ToolResult& result) {
    std::istringstream lines(result.err);
    std::vector<std::string> levels;
    for (std::string line; std::getline(lines, line);) {
      const json::Value object = test::parse_json(line);
      levels.push_back(object.contains("level") ? object["level"].string() : object["stage"].string());
    }
    return levels;
  };
  const std::vector<std::string> render = {
      "render", "builtin:furnace", "--width", "4",          "--height", "2", "--spp",
      "1",      "--log-json",      "-o",      dir / "a.exr"};
  EXPECT_THAT(levels_of(test::run_tool(render)), testing::ElementsAre("render")) << "progress, too";
  EXPECT_THAT(levels_of(test::run_tool({"render", "--log-json", "--widht", "8"})),
              testing::ElementsAre("error"))
      << "wrong usage";
  EXPECT_THAT(levels_of(test::run_tool({"render", dir / "none.glb", "--log-json", "-o", dir / "a.exr"})),
              testing::ElementsAre("error"));
  write_file(dir / "empty.toml", "");
  const Variable config("SSPHH_CONFIG", (dir / "empty.toml").c_str()), json("SSPHH_LOG_JSON", "1");
  EXPECT_THAT(levels_of(test::run_tool({"scene", "info", dir / "none.glb"})), testing::ElementsAre("error"));
}

}  // namespace
}  // namespace ssphh::app
