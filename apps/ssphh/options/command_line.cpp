#include "options/command_line.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <ssphh/core/nearest_word.h>

#include "options/settings.h"

namespace ssphh::app {
namespace {

template <class T>
constexpr bool has_default = true;
template <class T>
constexpr bool has_default<std::optional<T>> = false;
template <class T>
constexpr bool has_default<std::vector<T>> = false;

void forget_default_outside(CLI::Option& option, double least, double most) {
  const std::string text = option.get_default_str();
  if (text.empty()) return;
  const double value = std::strtod(text.c_str(), nullptr);
  if (value < least || value > most) option.default_str("");
}

/// Ranges alone let NaN pass: it is neither less nor more than anything.
void refuse_what_is_not_finite(CLI::Option& option) {
  const auto problem = [](const std::string& text) {
    return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : text + " is no finite number";
  };
  option.check(CLI::Validator(problem, ""));
}

template <class Visit>
void each_settable(CLI::App& app, const Visit& visit) {
  for (CLI::App* command : app.get_subcommands({})) each_settable(*command, visit);
  for (CLI::Option* option : app.get_options())
    if (option->get_configurable() && !option->get_lnames().empty()) visit(*option);
}

/// The command that a line chose, and how it is called.
std::pair<const CLI::App*, std::string> chosen_command(const CLI::App& root) {
  std::pair<const CLI::App*, std::string> chosen{&root, "ssphh"};
  while (!chosen.first->get_subcommands().empty()) {
    chosen.first = chosen.first->get_subcommands().front();
    chosen.second += " " + chosen.first->get_name();
  }
  return chosen;
}

std::string with_hint(const std::string& what, const std::string& word,
                      const std::vector<std::string>& known) {
  const std::string near = nearest_word(word, known);
  return what + (near.empty() ? "" : "; did you mean " + near + "?");
}

/// Words that nothing takes come before what is missing: a mistyped option is both.
std::string what_is_wrong(const CLI::App& command, const CLI::ParseError& error,
                          const std::vector<std::string>& left) {
  std::vector<std::string> commands, options;
  for (const CLI::App* one : command.get_subcommands({})) commands.push_back(one->get_name());
  for (const CLI::Option* one : command.get_options())
    for (const std::string& name : one->get_lnames()) options.push_back("--" + name);
  const auto is_option = [](const std::string& word) { return word.starts_with('-'); };
  if (left.empty() && error.get_name() == "RequiredError" && !commands.empty())
    return fmt::format("a command is missing: {}", fmt::join(commands, ", "));
  if (left.empty()) return error.what();
  if (!commands.empty() && !is_option(left.front()))
    return with_hint(fmt::format("no command '{}'", left.front()), left.front(), commands);
  const auto wrong = std::ranges::find_if(left, is_option);
  if (wrong == left.end()) return fmt::format("no place for '{}'", left.front());
  const std::string name = wrong->substr(0, wrong->find('='));
  if (std::ranges::count(options, name) > 0) return name + " stands before its command";
  return with_hint("no option " + name, name, options);
}

}  // namespace

Option Option::required(bool needed) const {
  option_->required(needed);
  if (needed) option_->default_str("");
  return *this;
}

Option Option::range(int least, int most) const {
  option_->check(CLI::Range(least, most));
  forget_default_outside(*option_, least, most);
  return *this;
}

Option Option::range(double least, double most) const {
  refuse_what_is_not_finite(*option_);
  option_->check(CLI::Range(least, most));
  forget_default_outside(*option_, least, most);
  return *this;
}

Option Option::positive() const {
  refuse_what_is_not_finite(*option_);
  option_->check(CLI::PositiveNumber);
  forget_default_outside(*option_, std::numeric_limits<double>::min(), std::numeric_limits<double>::max());
  return *this;
}

Option Option::non_negative() const {
  refuse_what_is_not_finite(*option_);
  option_->check(CLI::NonNegativeNumber);
  return *this;
}

Option Option::existing_file() const {
  option_->check(CLI::ExistingFile);
  return *this;
}

Option Option::one_of(const std::vector<std::string>& names) const {
  option_->check(CLI::IsMember(names));
  return *this;
}

Option Option::check(std::function<std::string(const std::string&)> problem, const std::string& kind) const {
  option_->check(
      CLI::Validator([problem = std::move(problem)](std::string& text) { return problem(text); }, kind));
  return *this;
}

Option Option::kind(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

Option Option::shown_default(const std::string& text) const {
  option_->default_str(text);
  return *this;
}

Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

Option Option::needs(const Option& other) const {
  option_->needs(other.option_);
  return *this;
}

Option Option::values(int count) const {
  option_->expected(count);
  return *this;
}

Option Option::repeatable() const {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::separated_by(char sign) const {
  option_->delimiter(sign);
  return *this;
}

Option Option::settable() const {
  const std::string variable = variable_of(option_->get_lnames().front());
  option_->configurable()->description(option_->get_description() + " [" + variable + "]");
  return *this;
}

bool Option::given() const {
  return option_->count() > 0;
}

std::string Option::name() const {
  return option_->get_name();
}

Option Command::headed(CLI::Option* option) const {
  if (!heading_.empty()) option->group(heading_);
  option->configurable(false);  // until it is settable()
  return Option(option);
}

template <class T>
Option Command::option(const std::string& names, T& target, const std::string& help) const {
  CLI::Option* option = app_->add_option(names, target, help);
  if constexpr (has_default<T>) option->capture_default_str();
  return headed(option);
}

template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, std::filesystem::path&, const std::string&) const;
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, float&, const std::string&) const;
template Option Command::option(const std::string&, double&, const std::string&) const;
template Option Command::option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::string>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<float>&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<int>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<float>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<double>&, const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::size_t>&, const std::string&) const;

Option Command::value(const std::string& names, const std::string& shown, const std::string& help,
                      const std::function<std::string(const std::string&)>& take) const {
  CLI::Option* option = app_->add_option_function<std::string>(
      names, [take](const auto& text) { take(text); }, help);
  return headed(option->default_str(shown)).check(take, "");
}

Option Command::choice(const std::string& names, const std::vector<std::string>& among,
                       const std::string& shown, const std::string& help,
                       std::function<void(const std::string&)> choose) const {
  CLI::Option* option = app_->add_option_function<std::string>(names, choose, help);
  return headed(option->check(CLI::IsMember(among))->default_str(shown));
}

Option Command::choices(const std::string& names, const std::vector<std::string>& among, char separator,
                        const std::string& help,
                        std::function<void(const std::vector<std::string>&)> choose) const {
  CLI::Option* option = app_->add_option_function<std::vector<std::string>>(names, choose, help);
  return headed(option->check(CLI::IsMember(among))).separated_by(separator);
}

Option Command::flag(const std::string& names, bool& target, const std::string& help) const {
  return headed(app_->add_flag(names, target, help));
}

Option Command::operator[](const std::string& name) const {
  return Option(app_->get_option(name));
}

Command Command::command(const std::string& name, const std::string& description) const {
  return Command(app_->add_subcommand(name, description));
}

Command Command::at(const std::string& name) const {
  return Command(app_->get_subcommand(name));
}

void Command::needs_command() const {
  app_->require_subcommand(1);
}

std::vector<std::string> Command::commands() const {
  std::vector<std::string> names;
  for (const CLI::App* command : app_->get_subcommands({})) names.push_back(command->get_name());
  return names;
}

void Command::footer(const std::string& text) const {
  app_->footer(text);
}

void Command::when_chosen(std::function<void()> action) const {
  app_->callback(std::move(action));
}

CommandLine::CommandLine(const std::string& description)
    : app_(std::make_unique<CLI::App>(description, "ssphh")) {}

CommandLine::~CommandLine() = default;

Command CommandLine::root() const {
  return Command(app_.get());
}

void CommandLine::version(const std::string& text) const {
  app_->set_version_flag("--version", text);
}

std::vector<std::string> CommandLine::settable() const {
  std::vector<std::string> names;
  each_settable(*app_, [&](const CLI::Option& option) {
    const std::string& name = option.get_lnames().front();
    if (std::ranges::count(names, name) == 0) names.push_back(name);
  });
  return names;
}

std::string CommandLine::set_default(const std::string& name, const std::string& value) const {
  try {
    each_settable(*app_, [&](CLI::Option& option) {
      if (option.get_lnames().front() == name)
        option.required(false)->run_callback_for_default()->default_val(value);
    });
    return {};
  } catch (const CLI::ParseError& e) {
    return e.what();
  }
}

void CommandLine::parse(std::vector<std::string> words) const {
  std::ranges::reverse(words);  // as CLI11 wants a vector
  try {
    app_->parse(words);
  } catch (const CLI::ParseError& e) {
    std::ostringstream out, err;
    const bool wrong = app_->exit(e, out, err) != 0;
    if (!wrong) throw ParsingEnded(out.str());
    const auto& [command, called] = chosen_command(*app_);
    throw ParsingEnded(what_is_wrong(*command, e, app_->remaining(true)), called + " --help");
  }
}

}  // namespace ssphh::app
