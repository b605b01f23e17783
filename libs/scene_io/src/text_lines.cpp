#include "text_lines.h"

#include <charconv>

namespace ssphh::scene_io {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

template <class T>
std::optional<T> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string_view TextLines::take_line() {
  const auto end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
  ++number_;
  if (const auto comment = line.find('#'); comment != line.npos) line = line.substr(0, comment);
  return trimmed(line);
}

bool TextLines::next() {
  while (!rest_.empty()) {
    line_ = take_line();
    if (line_.ends_with('\\')) {
      joined_.clear();
      while (line_.ends_with('\\') && !rest_.empty()) {
        joined_.append(line_.substr(0, line_.size() - 1)).push_back(' ');
        line_ = take_line();
      }
      joined_.append(line_);
      line_ = joined_;
    }
    if (!line_.empty()) return true;
  }
  return false;
}

std::string_view next_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

std::optional<float> parse_float(std::string_view word) {
  if (const auto value = parse_number<float>(word)) return value;
  // Too small for a float is 0, too large is an error
  if (const auto value = parse_number<double>(word); value && *value > -1 && *value < 1) return 0.0f;
  return std::nullopt;
}

std::optional<long long> parse_integer(std::string_view word) {
  return parse_number<long long>(word);
}

}  // namespace ssphh::scene_io
