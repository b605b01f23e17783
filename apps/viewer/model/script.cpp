#include "script.h"

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

namespace ssphh::viewer {
namespace {

std::vector<std::string> split(std::string_view line, const std::string& where) {
  std::vector<std::string> words;
  std::size_t i = 0;
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  for (;;) {
    while (i < line.size() && blank(line[i])) ++i;
    if (i == line.size() || line[i] == '#') return words;
    std::string& word = words.emplace_back();
    if (line[i] == '"') {
      const std::size_t end = line.find('"', i + 1);
      if (end == std::string_view::npos) throw Error(where, "a quote does not end");
      word = line.substr(i + 1, end - i - 1);
      i = end + 1;
    } else {
      while (i < line.size() && !blank(line[i])) word += line[i++];
    }
  }
}

}  // namespace

std::vector<ScriptLine> parse_script(std::string_view text, const std::string& name) {
  std::vector<ScriptLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    ScriptLine line{fmt::format("{}: line {}", name, number), {}};
    line.words = split(text.substr(0, end), line.where);
    if (!line.words.empty()) lines.push_back(std::move(line));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return lines;
}

std::vector<ScriptLine> read_script(const std::filesystem::path& file) {
  return parse_script(read_text_file(file, std::uint64_t{1} << 20), file.string());
}

void expect_words(const ScriptLine& line, std::size_t count, const std::string& usage) {
  if (line.words.size() != count + 1) throw Error(line.where, "is not of the form: " + usage);
}

}  // namespace ssphh::viewer
