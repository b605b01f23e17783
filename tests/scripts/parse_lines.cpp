// What the tool's own parser has to say of command lines, none of which is run: on stdin a line for each,
// with a tab between words; behind a first word "part" the rest is a part of a command line, which may lack
// what is required. On stdout a line "KIND<tab>MESSAGE" for each, KIND being CLI11's name of the mistake, or
// "ok".

#include <iostream>
#include <sstream>

#include <CLI/CLI.hpp>

#include "commands/command.h"

namespace {

using ssphh::app::CommandLine;

/// Options say what is wrong with themselves alone.
void set_free(CLI::App& command) {
  command.require_subcommand(0);
  for (CLI::Option* option : command.get_options()) {
    option->required(false);
    for (CLI::Option* other : std::set<CLI::Option*>(option->get_needs())) option->remove_needs(other);
    for (CLI::Option* other : std::set<CLI::Option*>(option->get_excludes())) option->remove_excludes(other);
  }
  for (CLI::App* below : command.get_subcommands({})) set_free(*below);
}

std::string answer(const CommandLine& line, const std::vector<std::string>& words) {
  try {
    line.root().implementation().parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return "ok\t";
  } catch (const CLI::ExtrasError& e) {  // has the program's name
    return std::string("ExtrasError\t") + e.what();
  } catch (const CLI::ParseError& e) {
    return e.get_name() + "\t" + e.what();
  } catch (const std::exception& e) {
    return std::string("Error\t") + e.what();
  }
}

}  // namespace

int main() {
  ssphh::app::Context context;
  const CommandLine whole("ssphh"), part("ssphh");
  for (const CommandLine* line : {&whole, &part}) ssphh::app::add_commands(line->root(), context);
  set_free(part.root().implementation());
  for (std::string text; std::getline(std::cin, text);) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, '\t');) words.push_back(word);
    const bool is_part = !words.empty() && words.front() == "part";
    if (is_part) words.erase(words.begin());
    std::string told = answer(is_part ? part : whole, words);
    for (char& c : told)
      if (c == '\n') c = ' ';
    std::cout << told << std::endl;
  }
}
