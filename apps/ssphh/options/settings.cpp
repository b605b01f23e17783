#include "options/settings.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/nearest_word.h>
#include <ssphh/core/parse_number.h>
#include <ssphh/core/user_folder.h>

namespace ssphh::app {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// What the environment says; empty as if it said nothing.
std::string variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value ? value : "";
}

/// The word after --config, or what follows its equals sign; the last one counts, as with any option.
std::string named_file(const std::vector<std::string>& words) {
  std::string file = variable("SSPHH_CONFIG");
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--config" && i + 1 < words.size()) file = words[i + 1];
    if (words[i].starts_with("--config=")) file = words[i].substr(9);
  }
  return file;
}

/// Of what stands behind the equals sign, a comment included.
std::string value_of(std::string_view text, const std::string& where) {
  const bool quoted = text.starts_with('"') || text.starts_with('\'');
  const std::size_t end = quoted ? text.find(text[0], 1) : std::min(text.find('#'), text.size());
  if (end == text.npos) throw Error(where, "the closing quotation mark is missing");
  const std::string_view rest = trimmed(text.substr(quoted ? end + 1 : end));
  if (!rest.empty() && rest[0] != '#') throw Error(where, fmt::format("\"{}\" follows the value", rest));
  if (!quoted) {
    const std::string_view bare = trimmed(text.substr(0, end));
    if (bare != "true" && bare != "false" && !parse_number<double>(bare))
      throw Error(where, fmt::format("\"{}\" is no number, true or false", bare),
                  "texts stand in quotation marks");
    return std::string(bare);
  }
  const std::string_view value = text.substr(1, end - 1);
  if (text[0] == '"' && value.find('\\') != value.npos)
    throw Error(where, "backslashes are not read", "write '…' in place of \"…\"");
  return std::string(value);
}

Setting setting_of(std::string_view line, const std::string& where, const std::vector<std::string>& keys) {
  const std::size_t equals = line.find('=');
  if (equals == line.npos)
    throw Error(where, fmt::format("\"{}\" is no setting", line), "a line reads KEY = VALUE, without tables");
  const std::string key(trimmed(line.substr(0, equals)));
  if (std::ranges::count(keys, key) == 0)
    throw Error(where, fmt::format("\"{}\" is no option with a default of your own", key),
                nearest_hint(key, keys) + "; what changes results belongs to command lines");
  return {key, value_of(trimmed(line.substr(equals + 1)), where), where};
}

/// Takes the place of one with the same key.
void put(std::vector<Setting>& settings, Setting setting) {
  const auto found = std::ranges::find(settings, setting.key, &Setting::key);
  if (found == settings.end())
    settings.push_back(std::move(setting));
  else
    *found = std::move(setting);
}

}  // namespace

std::string variable_of(const std::string& key) {
  std::string name = "SSPHH_" + key;
  for (char& c : name) c = c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

Settings read_settings(const std::vector<std::string>& words, const std::vector<std::string>& keys) {
  const std::string named = named_file(words);
  if (named == "none") return {};
  Settings settings;
  settings.file = named.empty() ? user_folder("XDG_CONFIG_HOME", ".config") / "config.toml"
                                : std::filesystem::path(named);
  std::error_code ignored;
  settings.found = !named.empty() || std::filesystem::exists(settings.file, ignored);
  if (settings.found) {
    std::istringstream text(read_text_file(settings.file, 1 << 20));
    int number = 0;
    for (std::string line; std::getline(text, line);) {
      const std::string where = fmt::format("{}:{}", settings.file.string(), ++number);
      const std::string_view words_of_line = trimmed(line);
      if (words_of_line.empty() || words_of_line[0] == '#') continue;
      Setting setting = setting_of(words_of_line, where, keys);
      if (std::ranges::count(settings.in_force, setting.key, &Setting::key) > 0)
        throw Error(where, fmt::format("\"{}\" stands twice", setting.key));
      settings.in_force.push_back(std::move(setting));
    }
  }
  for (const std::string& key : keys) {
    const std::string value = variable(variable_of(key));
    if (!value.empty()) put(settings.in_force, {key, value, variable_of(key)});
  }
  std::ranges::sort(settings.in_force, {}, &Setting::key);
  return settings;
}

void apply_settings(const CommandLine& line, const Settings& settings) {
  for (const Setting& setting : settings.in_force) {
    const std::string problem = line.set_default(setting.key, setting.value);
    if (!problem.empty())
      throw Error(setting.from, fmt::format("{} = \"{}\": {}", setting.key, setting.value, problem));
  }
}

}  // namespace ssphh::app
