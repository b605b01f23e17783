// Every option of every command: what it takes, within which limits, and its default, as
// tests/cli/options.txt says. A change there is a change for users.

#include <algorithm>
#include <map>
#include <set>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "commands/command.h"
#include "places.h"

namespace ssphh::app {
namespace {

std::set<std::string> names(const std::set<CLI::Option*>& options) {
  std::set<std::string> result;
  for (const CLI::Option* option : options) result.insert(option->get_name());
  return result;
}

/// "--spp INT in [1 - 65536] = 4, required".
std::string describe(const CLI::Option& option) {
  std::string text = option.get_name(false, true);
  const std::string type = option.get_type_name();
  if (!type.empty() && option.get_items_expected_max() > 0) text += " " + type;
  if (!option.get_default_str().empty()) text += " = " + option.get_default_str();
  if (option.get_items_expected_max() > 1) {
    text += ", " + std::to_string(option.get_items_expected_min());
    if (option.get_items_expected_max() > option.get_items_expected_min()) text += " or more";
  }
  if (option.get_delimiter() != '\0') text += std::string(", by '") + option.get_delimiter() + "'";
  if (option.get_configurable()) text += ", settable";
  if (option.get_required()) text += ", required";
  for (const std::string& name : names(option.get_excludes())) text += ", not with " + name;
  for (const std::string& name : names(option.get_needs())) text += ", only with " + name;
  return text;
}

class Listing {
 public:
  void add(const CLI::App& app, const std::string& name) {
    EXPECT_FALSE(app.get_description().empty()) << name;
    for (const CLI::App* command : app.get_subcommands({}))
      add(*command, name.empty() ? command->get_name() : name + " " + command->get_name());
    if (app.get_subcommands({}).empty()) add_options(app, name);
  }
  const std::string& text() const { return text_; }

 private:
  void add_options(const CLI::App& command, const std::string& name) {
    std::vector<std::pair<std::string, std::string>> groups;  // with their options
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_name() == "--help") continue;
      EXPECT_FALSE(option->get_description().empty()) << name << " " << option->get_name();
      const std::string group = option->get_group();
      if (groups.empty() || groups.back().first != group) groups.emplace_back(group, "");
      groups.back().second += "  " + describe(*option) + "\n";
    }
    std::string shared, own;
    for (const auto& [group, options] : groups) {
      // What several commands share stands once.
      const bool large = std::ranges::count(options, '\n') > 2;
      const auto [known, is_new] = first_.emplace(group + "\n" + options, name);
      if (large && !is_new)
        shared += ", " + group + " of " + known->second;
      else
        own += (group == "Options" ? "" : " " + group + "\n") + options;
    }
    text_ += name + shared + "\n" + own;
  }

  std::map<std::string, std::string> first_;
  std::string text_;
};

std::string all_options() {
  Context context;
  const CommandLine line("ssphh");
  add_commands(line.root(), context);
  Listing listing;
  listing.add(line.root().implementation(), "");
  return listing.text();
}

TEST(Options, AreThoseOfTheList) {
  const std::filesystem::path file = test::source_dir() / "tests/cli/options.txt";
  const std::string all = all_options();
  EXPECT_EQ(read_text_file(file), all) << "tests/cli/options.txt as it would be:\n" << all;
}

}  // namespace
}  // namespace ssphh::app
