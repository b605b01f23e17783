// What stands below the options in each command's help.

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "commands/command.h"
#include "expected_text.h"

namespace ssphh::app {
namespace {

void add(const CLI::App& app, const std::string& name, std::string& text) {
  if (!app.get_footer().empty()) text += name + "\n" + app.get_footer() + "\n\n";
  for (const CLI::App* command : app.get_subcommands({}))
    add(*command, name + " " + command->get_name(), text);
}

TEST(Footers, AreThoseOfTheList) {
  Context context;
  const CommandLine line("ssphh");
  add_commands(line.root(), context);
  std::string text;
  add(line.root().implementation(), "ssphh", text);
  test::expect_text_of("tests/cli/expected/footers.txt", text);
}

}  // namespace
}  // namespace ssphh::app
