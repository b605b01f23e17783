#pragma once
/// A long result against a file of the tree that says what it was: a scene's every number, an exporter's
/// every line.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "places.h"

namespace ssphh::test {

/// What a number of another compiler or machine may differ by: a few roundings of sums and of sines in float,
/// and less than the smallest change that anybody would make on purpose.
inline bool same_number(double a, double b) {
  return a == b || std::abs(a - b) <= 1e-6 + 1e-5 * std::max(std::abs(a), std::abs(b));
}

/// Whether two lines agree in their text exactly and in their numbers within rounding.
inline bool same_line(std::string_view a, std::string_view b) {
  const auto begins_number = [](std::string_view s) {
    const auto digit = [&](std::size_t i) {
      return i < s.size() && std::isdigit(static_cast<unsigned char>(s[i]));
    };
    return digit(0) || (s.starts_with('-') && (digit(1) || (s.substr(1).starts_with('.') && digit(2))));
  };
  while (!a.empty() && !b.empty()) {
    if (begins_number(a) && begins_number(b)) {
      char *end_a = nullptr, *end_b = nullptr;
      const std::string number_a(a.substr(0, 40)), number_b(b.substr(0, 40));
      const double x = std::strtod(number_a.c_str(), &end_a), y = std::strtod(number_b.c_str(), &end_b);
      if (!same_number(x, y)) return false;
      a.remove_prefix(static_cast<std::size_t>(end_a - number_a.c_str()));
      b.remove_prefix(static_cast<std::size_t>(end_b - number_b.c_str()));
    } else {
      if (a.front() != b.front()) return false;
      a.remove_prefix(1), b.remove_prefix(1);
    }
  }
  return a.empty() && b.empty();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// `file`: below the root of the tree. Says which lines differ; with SSPHH_UPDATE_EXPECTED=1 in the
/// environment it writes the file anew, for a change that is meant: read the difference before it is
/// committed.
inline void expect_text_of(const std::string& file, const std::string& text) {
  const std::filesystem::path path = source_dir() / file;
  if (std::getenv("SSPHH_UPDATE_EXPECTED") != nullptr) write_file(path, text);
  ASSERT_TRUE(std::filesystem::exists(path)) << file << " as it would be:\n" << text;
  const std::vector<std::string> expected = lines_of(read_text_file(path)), lines = lines_of(text);
  std::string differences;
  for (std::size_t i = 0, shown = 0; i < std::max(expected.size(), lines.size()) && shown < 10; ++i) {
    const std::string was = i < expected.size() ? expected[i] : "(nothing)";
    const std::string is = i < lines.size() ? lines[i] : "(nothing)";
    if (i < expected.size() && i < lines.size() && same_line(was, is)) continue;
    differences += fmt::format("line {}\n  was {}\n  is  {}\n", i + 1, was, is);
    ++shown;
  }
  EXPECT_TRUE(differences.empty())
      << file << "\n"
      << differences << "If that is meant: SSPHH_UPDATE_EXPECTED=1, run this test again, read git diff.";
}

}  // namespace ssphh::test
