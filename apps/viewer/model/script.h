#pragma once
/// Scripts for the viewer (docs/viewer.md): what a user would do, line by line, for demonstrations and tests.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ssphh::viewer {

struct ScriptLine {
  std::string where;               ///< "demo.txt: line 3"
  std::vector<std::string> words;  ///< never empty; the first one is the verb
};

/// One command a line; words are parted by blanks, "quoted ones" may hold some; # begins a comment. Throws
/// Error for a quote that does not end.
std::vector<ScriptLine> parse_script(std::string_view text, const std::string& name);
std::vector<ScriptLine> read_script(const std::filesystem::path& file);

/// Number of words after the verb; throws Error with `usage` for another one.
void expect_words(const ScriptLine& line, std::size_t count, const std::string& usage);

}  // namespace ssphh::viewer
