// Defaults of the user's own: which options may have them, where they come from, which wins, and what is
// refused.

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "commands/command.h"
#include "error_message.h"
#include "temp_dir.h"
#include "tool_checks.h"
#include "variable.h"

namespace ssphh::app {
namespace {

using test::message_of;
using test::TempDir;
using test::Variable;
using testing::ElementsAre;
using testing::HasSubstr;

/// A command line that was parsed with the user's settings, as main() does it.
struct Parsed {
  Context context;
  CommandLine line{"ssphh"};

  explicit Parsed(const std::vector<std::string>& words) {
    add_commands(line.root(), context);
    context.settings = read_settings(words, line.settable());
    apply_settings(line, context.settings);
    line.parse(words);
  }
};

class SettingsOfAUser : public testing::Test {
 protected:
  void write(const std::string& text) { write_file(dir_ / "ssphh/config.toml", text); }
  std::string problem(const std::string& text) {
    write(text);
    std::string message = message_of([] { Parsed({"scene", "list"}); });
    const std::string folder = dir_.path().string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }

  TempDir dir_;
  std::filesystem::path made_ = (std::filesystem::create_directory(dir_ / "ssphh"), dir_ / "ssphh");
  Variable home_{"XDG_CONFIG_HOME", dir_.path().c_str()}, config_{"SSPHH_CONFIG", nullptr},
      threads_{"SSPHH_THREADS", nullptr};
};

TEST_F(SettingsOfAUser, AreTheDefaultsOfEveryCommand) {
  write("# mine\nthreads = 3  # of four\n\nprogress = \"none\"\nbroker = 'tcp://10.0.0.1:5555'\n");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"scene", "list"},
                                                {"sh", "eval", "--direction", "0", "1", "0"},
                                                {"worker"}}) {
    const Parsed parsed(words);
    EXPECT_EQ(parsed.context.threads, 3);
    EXPECT_EQ(parsed.context.progress, ProgressStyle::none);
  }
}

TEST_F(SettingsOfAUser, TheCommandLineBeatsTheEnvironmentWhichBeatsTheFile) {
  write("threads = 3\nprogress = \"json\"\n");
  EXPECT_EQ(Parsed({"scene", "list"}).context.threads, 3);
  const Variable variable("SSPHH_THREADS", "2");
  const Parsed parsed({"scene", "list"});
  EXPECT_EQ(parsed.context.threads, 2);
  EXPECT_EQ(parsed.context.progress, ProgressStyle::json) << "which only the file says";
  EXPECT_EQ(Parsed({"scene", "list", "--threads", "1"}).context.threads, 1);
  ASSERT_EQ(parsed.context.settings.in_force.size(), 2u);
  EXPECT_EQ(parsed.context.settings.in_force[0].from, (dir_ / "ssphh/config.toml:2").string());
  EXPECT_EQ(parsed.context.settings.in_force[1].from, "SSPHH_THREADS");
  const Variable empty("SSPHH_THREADS", "");
  EXPECT_EQ(Parsed({"scene", "list"}).context.threads, 3);
}

TEST_F(SettingsOfAUser, AnotherFileOrNone) {
  write("threads = 3\n");
  write_file(dir_ / "b.toml", "threads = 4\n");
  EXPECT_EQ(Parsed({"scene", "list", "--config", dir_ / "b.toml"}).context.threads, 4);
  EXPECT_EQ(Parsed({"scene", "list", "--config=" + (dir_ / "b.toml").string()}).context.threads, 4);
  const Variable variable("SSPHH_THREADS", "2");
  EXPECT_EQ(Parsed({"scene", "list", "--config", "none"}).context.threads, 0) << "nor variables";
  const Variable none("SSPHH_CONFIG", "none");
  EXPECT_EQ(Parsed({"scene", "list"}).context.threads, 0);
  EXPECT_THAT(message_of([&] {
                Parsed({"scene", "list", "--config", dir_ / "c.toml"});
              }),
              HasSubstr("c.toml"));
  std::filesystem::remove(dir_ / "ssphh/config.toml");
  const Variable usual("SSPHH_CONFIG", nullptr);
  EXPECT_EQ(Parsed({"scene", "list"}).context.threads, 2) << "the usual file need not be there";
}

TEST_F(SettingsOfAUser, WhatChangesResultsIsNoSetting) {
  Context context;
  const CommandLine line("ssphh");
  add_commands(line.root(), context);
  EXPECT_THAT(line.settable(),
              testing::UnorderedElementsAre("threads", "progress", "log-json", "broker", "keys"));
  EXPECT_THAT(
      problem("seed = 3\n"),
      testing::AllOf(HasSubstr("ssphh/config.toml:1: \"seed\" is no option with a default of your own"),
                     HasSubstr("what changes results belongs to command lines")));
}

TEST_F(SettingsOfAUser, CommandLinesOfAReportAreThoseOfItsPlan) {
  write("threads = 2\n");
  write_file(dir_ / "plan.json",
             R"({"scenes": [{"name": "box", "scene": "builtin:box"}],
                 "methods": [{"name": "a", "steps": ["render {scene} --width 8 --height 4 --spp 1 -o o.exr"], "picture": "o.exr"}]})");
  const auto command_of = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"report", dir_ / "plan.json", "-o", dir_ / out};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(test::run_tool(words).exit_code, 0);
    const json::Value report = test::parse_json(read_text_file(dir_ / out / "report.json"));
    return report["cells"][0]["steps"][0]["command"].string();
  };
  ::setenv("SSPHH_CONFIG", (dir_ / "ssphh/config.toml").c_str(), 1);
  EXPECT_THAT(command_of("a", {}), testing::Not(HasSubstr("--threads")));
  EXPECT_THAT(command_of("b", {"--threads", "1"}), HasSubstr("--threads 1"));
}

TEST_F(SettingsOfAUser, NoWorkGoesToAFarmUnlessTheCommandLineSaysSo) {
  const Variable broker("SSPHH_BROKER", "tcp://192.0.2.1:5555");
  const TempDir out;
  const std::string nothing = out / "nothing.toml";
  write_file(nothing, "");
  test::run_tool({"render", "builtin:furnace", "--width", "4", "--height", "2", "--spp", "1", "--config",
                  nothing, "-o", out / "a.exr"});
  EXPECT_TRUE(std::filesystem::exists(out / "a.exr"));
  test::expect_failure({"farm", "status", "--config", nothing}, "tcp://192.0.2.1:5555");
}

TEST_F(SettingsOfAUser, ALocalFarmReadsNone) {
  const TempDir out;
  write_file(out / "nothing.toml", "");
  // Its broker has no keys, and a worker with others would never be heard.
  const Variable config("SSPHH_CONFIG", (out / "nothing.toml").c_str()), keys("SSPHH_KEYS", "/no/keys");
  const test::ToolResult result =
      test::run_tool({"render", "builtin:furnace", "--width", "4", "--height", "2", "--spp", "1", "--local",
                      "1", "--cache", "none", "-o", out / "a.exr"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(SettingsOfAUser, WhatIsWrongIsToldWithItsLine) {
  EXPECT_THAT(problem("\nthread = 2\n"), HasSubstr("config.toml:2: \"thread\" is no option"));
  EXPECT_THAT(problem("thread = 2\n"), HasSubstr("did you mean \"threads\"?"));
  EXPECT_THAT(problem("threads\n"),
              HasSubstr("config.toml:1: \"threads\" is no setting (a line reads KEY = VALUE"));
  EXPECT_THAT(problem("[farm]\n"), HasSubstr("config.toml:1: \"[farm]\" is no setting"));
  EXPECT_THAT(problem("threads = 2\nthreads = 3\n"), HasSubstr("config.toml:2: \"threads\" stands twice"));
  EXPECT_THAT(problem("threads = 5000\n"), HasSubstr("config.toml:1: threads = \"5000\": "));
  EXPECT_THAT(problem("threads = two\n"),
              HasSubstr("config.toml:1: \"two\" is no number, true or false (texts"));
  EXPECT_THAT(problem("progress = \"loud\"\n"), HasSubstr("config.toml:1: progress = \"loud\": "));
  EXPECT_THAT(problem("threads =\n"), HasSubstr("config.toml:1: \"\" is no number, true or false"));
  EXPECT_THAT(problem("keys = /keys\n"), HasSubstr("config.toml:1: \"/keys\" is no number, true or false"));
  EXPECT_THAT(problem("keys = \"a\\n\"\n"), HasSubstr("config.toml:1: backslashes are not read"));
  EXPECT_THAT(problem("keys = \"a\n"), HasSubstr("config.toml:1: the closing quotation mark is missing"));
  EXPECT_THAT(problem("keys = 'a' b\n"), HasSubstr("config.toml:1: \"b\" follows the value"));
  write("threads = 1\n");
  const Variable variable("SSPHH_THREADS", "many");
  EXPECT_THAT(message_of([] {
                Parsed({"scene", "list"});
              }),
              testing::StartsWith("SSPHH_THREADS: threads = \"many\": "));
}

TEST_F(SettingsOfAUser, TheToolRefusesWrongOnesAsWrongUsageAndTheDoctorTellsOfThem) {
  const std::string file = dir_ / "b.toml";
  write_file(file, "threads = -1\n");
  test::expect_failure({"scene", "list", "--config", file}, {"b.toml:1: threads = \"-1\""}, 2);
  EXPECT_EQ(test::run_tool({"--version"}).exit_code, 0);
  write_file(file, "threads = 1\n");
  const test::ToolResult result = test::run_tool({"doctor", "--config", file});
  EXPECT_THAT(result.out, HasSubstr("threads = 1, by " + file + ":1\n"));
  EXPECT_THAT(result.out, HasSubstr("ok threads       1 on "));
  EXPECT_THAT(test::run_tool({"doctor", "--help"}).out, HasSubstr("[SSPHH_THREADS]"));
}

}  // namespace
}  // namespace ssphh::app
