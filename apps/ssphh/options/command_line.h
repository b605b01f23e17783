#pragma once
/// What a command line may say: commands, their options, and the help that tells of them. CLI11 stands behind
/// it, in command_line.cpp alone: its templates take seconds of every file that sees them.

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace ssphh::app {

/// An option, a flag or a positional argument of a Command, and valid as long as its CommandLine. Every
/// function returns the option, to be told more.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required(bool needed = true) const;
  /// Refuses values outside [least, most]. A default outside stands for "not given" and is not shown.
  Option range(int least, int most) const;
  Option range(double least, double most) const;
  Option positive() const;  ///< as range(); 0 stands for "not given"
  Option non_negative() const;
  Option existing_file() const;
  /// Refuses what is none of these.
  Option one_of(const std::vector<std::string>& names) const;
  /// Refuses what `problem` has something to say of; `kind` is what --help calls the values. May be empty.
  Option check(std::function<std::string(const std::string&)> problem, const std::string& kind) const;
  Option kind(const std::string& name) const;  ///< what --help calls the values, in place of TEXT or INT
  Option shown_default(const std::string& text) const;
  Option excludes(const Option& other) const;
  Option needs(const Option& other) const;
  Option values(int count) const;        ///< takes so many values at once
  Option repeatable() const;             ///< may be given again, with one value each time
  Option separated_by(char sign) const;  ///< many values in one word
  /// Its default may be the user's own (settings.h), which --help tells. Only for what changes no result.
  Option settable() const;

  bool given() const;  ///< once the line is parsed
  std::string name() const;

 private:
  CLI::Option* option_;
};

/// A command or a group of commands, valid as long as its CommandLine.
class Command {
 public:
  explicit Command(CLI::App* app, std::string heading = "") : app_(app), heading_(std::move(heading)) {}

  /// The same command: options that are added through this stand under a heading of their own in --help.
  Command under(const std::string& heading) const { return Command(app_, heading); }

  /// `names` as "-o,--output", or "FILE" for a positional argument. The value that `target` has is the
  /// default and is shown. T is std::string, a path, int, std::uint64_t, float, double, or a std::optional or
  /// a vector of one.
  template <class T>
  Option option(const std::string& names, T& target, const std::string& help) const;
  /// A value that `take` takes from its text; what it returns is wrong with that, or empty.
  Option value(const std::string& names, const std::string& shown, const std::string& help,
               const std::function<std::string(const std::string&)>& take) const;
  /// One of an enum's values, by the names of its table; `among`: only these.
  template <class E>
  Option choice(const std::string& names, E& target, const std::string& help,
                const std::vector<std::string>& among = names_of<E>()) const {
    return choice(names, among, std::string(name_of(target)), help,
                  [&target](const std::string& name) { target = *parse_enum<E>(name); });
  }
  template <class E>
  Option choice(const std::string& names, std::optional<E>& target, const std::string& help,
                const std::vector<std::string>& among = names_of<E>()) const {
    return choice(names, among, "", help,
                  [&target](const std::string& name) { target = *parse_enum<E>(name); });
  }
  /// Some of an enum's values, `separator` between their names.
  template <class E>
  Option choices(const std::string& names, std::vector<E>& targets, char separator, const std::string& help,
                 const std::vector<std::string>& among = names_of<E>()) const {
    return choices(names, among, separator, help, [&targets](const std::vector<std::string>& chosen) {
      targets.clear();
      for (const std::string& name : chosen) targets.push_back(*parse_enum<E>(name));
    });
  }
  /// `names` as "--resume,!--no-resume": the second sets the target to false.
  Option flag(const std::string& names, bool& target, const std::string& help) const;
  /// The option of that name; there must be one.
  Option operator[](const std::string& name) const;

  Command command(const std::string& name, const std::string& description) const;
  Command at(const std::string& name) const;  ///< the command of that name; there must be one
  std::vector<std::string> commands() const;  ///< their names
  void needs_command() const;                 ///< makes it a group: one of its commands must follow

  void footer(const std::string& text) const;
  void when_chosen(std::function<void()> action) const;  ///< called while the line is parsed

  CLI::App& implementation() const { return *app_; }

 private:
  Option choice(const std::string& names, const std::vector<std::string>& among, const std::string& shown,
                const std::string& help, std::function<void(const std::string&)> choose) const;
  Option choices(const std::string& names, const std::vector<std::string>& among, char separator,
                 const std::string& help, std::function<void(const std::vector<std::string>&)> choose) const;
  Option headed(CLI::Option* option) const;

  CLI::App* app_;
  std::string heading_;  ///< empty: the one that CLI11 gives
};

/// Thrown where a line names no command that could run: wrong usage, or help or the version was asked for.
struct ParsingEnded : std::runtime_error {
  explicit ParsingEnded(const std::string& asked_for) : std::runtime_error(asked_for) {}
  ParsingEnded(const std::string& wrong, std::string help_command)
      : std::runtime_error(wrong), help(std::move(help_command)) {}

  std::string help;  ///< command that tells what would be right; empty: what() is the text that was asked for
};

class CommandLine {
 public:
  explicit CommandLine(const std::string& description);
  ~CommandLine();

  Command root() const;
  void version(const std::string& text) const;  ///< adds --version

  /// Names, without dashes, of the options that are settable().
  std::vector<std::string> settable() const;
  /// Gives the settable options of that name in all commands another default, which goes into their targets
  /// at once; what is required no longer is. What is wrong with the value, or empty.
  std::string set_default(const std::string& name, const std::string& value) const;

  /// `words`: what follows the program's name. Sets the options' targets. Throws ParsingEnded.
  void parse(std::vector<std::string> words) const;

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace ssphh::app
