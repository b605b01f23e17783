// What somebody reads who mistypes a command line, and that a mistyped option is told before what is missing.

#include <gtest/gtest.h>

#include "commands/command.h"

namespace ssphh::app {
namespace {

/// What is wrong, and behind it the command that helps.
std::string said(const std::vector<std::string>& words) {
  Context context;
  const CommandLine line("ssphh");
  line.root().needs_command();
  add_commands(line.root(), context);
  try {
    line.parse(words);
  } catch (const ParsingEnded& ended) {
    return std::string(ended.what()) + " | " + ended.help;
  }
  return "nothing";
}

TEST(Usage, AMistypedWordIsToldWithWhatIsNearIt) {
  EXPECT_EQ(said({"rendr", "a.glb"}), "no command 'rendr'; did you mean render? | ssphh --help");
  EXPECT_EQ(said({"probe", "infoo", "a.sphl"}),
            "no command 'infoo'; did you mean info? | ssphh probe --help");
  EXPECT_EQ(said({"render", "builtin:cornell", "--widht", "4"}),
            "no option --widht; did you mean --width? | ssphh render --help");
  EXPECT_EQ(said({"probe", "info", "a.sphl", "--tolerence=4"}),
            "no option --tolerence | ssphh probe info --help");
  EXPECT_EQ(said({"render", "builtin:cornell", "-q"}), "no option -q | ssphh render --help");
  EXPECT_EQ(said({"bake", "builtin:cornell", "more", "-o", "a.sphl"}),
            "no place for 'more' | ssphh bake --help");
}

TEST(Usage, AnOptionBeforeItsCommandIsNoMistypedOne) {
  EXPECT_EQ(said({"--log-json", "render", "builtin:cornell", "-o", "a.exr"}),
            "--log-json stands before its command | ssphh render --help");
}

TEST(Usage, WhatIsMissingIsNamed) {
  EXPECT_EQ(said({"render"}), "SCENE is required | ssphh render --help");
  EXPECT_EQ(said({"render", "builtin:cornell"}), "--output is required | ssphh render --help");
  EXPECT_EQ(said({"sh"}).substr(0, 22), "a command is missing: ");
  EXPECT_EQ(said({}).substr(0, 22), "a command is missing: ");
}

TEST(Usage, ValuesOutOfRangeAreTold) {
  EXPECT_EQ(said({"render", "builtin:cornell", "-o", "a.exr", "--width", "0"}),
            "--width: Value 0 not in range 1 to 65536 | ssphh render --help");
}

TEST(Usage, HelpIsNoMistake) {
  const std::string help = said({"probe", "info", "--help"});
  EXPECT_NE(help.find("Usage: ssphh probe info "), std::string::npos) << help;
  EXPECT_TRUE(help.ends_with(" | ")) << help;
}

}  // namespace
}  // namespace ssphh::app
