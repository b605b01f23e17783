#pragma once
/// Lines and words of the Wavefront text formats.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ssphh::scene_io {

/// Steps through lines that are not empty; comments are cut off, a backslash at the end joins the next line.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  /// False at the end of the text.
  bool next();
  std::string_view line() const { return line_; }
  /// Number of the line, from 1; of the last one where lines are joined.
  std::size_t number() const { return number_; }

 private:
  std::string_view take_line();

  std::string_view rest_, line_;
  std::string joined_;
  std::size_t number_ = 0;
};

/// Takes the first word off a line; empty at its end.
std::string_view next_word(std::string_view& line);

/// The line without blanks at its ends.
std::string_view trimmed(std::string_view line);

/// A whole word as a number; nullopt when it is none. "nan" and "inf" are numbers here: the caller tells the
/// place.
std::optional<float> parse_float(std::string_view word);
std::optional<long long> parse_integer(std::string_view word);

}  // namespace ssphh::scene_io
