#pragma once
/// Defaults of the user's own, from a file and from the environment: for options that change no result.

#include <filesystem>
#include <string>
#include <vector>

#include "options/command_line.h"

namespace ssphh::app {

/// The default of option --KEY in every command that has it and lets it be set (Option::settable).
struct Setting {
  std::string key, value;
  std::string from;  ///< "FILE:LINE" or the variable's name
};

struct Settings {
  std::filesystem::path file;  ///< that was looked for; empty: none was wanted, nor variables
  bool found = false;
  std::vector<Setting> in_force;  ///< by key; the environment's where both say something
};

/// "SSPHH_LOG_JSON" of "log-json".
std::string variable_of(const std::string& key);

/// Of the file that `words` name by --config, else SSPHH_CONFIG, else config.toml in the user's own folder,
/// which need not be there; and of the variables of `keys`. "none" stands for neither. The file holds lines
/// KEY = VALUE of TOML: texts in quotes, numbers, true and false. Throws Error that names file and line for a
/// file that cannot be read, a line of another form, and a key that is unknown or stands twice.
Settings read_settings(const std::vector<std::string>& words, const std::vector<std::string>& keys);

/// Makes them the defaults of a command line. Throws Error that says whence a value is that its option
/// refuses.
void apply_settings(const CommandLine& line, const Settings& settings);

}  // namespace ssphh::app
