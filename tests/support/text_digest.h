#pragma once
/// A long text as a line: what its words are, and sums of its numbers, each weighted by its place.

#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "scene_text.h"

namespace ssphh::test {

struct TextDigest {
  std::string words;  ///< all that is no number
  std::size_t count = 0;
  /// Of the numbers, one after the other in turns: neither two may be swapped nor all be shifted. Of the
  /// logarithms of large ones, beside which small ones would not be seen.
  std::array<double, 4> sums{};
};

inline TextDigest digest_of(std::string_view text) {
  TextDigest out;
  for (std::size_t i = 0; i < text.size();) {
    const auto digit = [&](std::size_t k) {
      return k < text.size() && std::isdigit(static_cast<unsigned char>(text[k])) != 0;
    };
    if (!digit(i) && !(text[i] == '-' && digit(i + 1))) {
      out.words += text[i++];
      continue;
    }
    const std::string rest(text.substr(i, 40));
    char* end = nullptr;
    const double number = std::strtod(rest.c_str(), &end);
    out.sums[out.count % out.sums.size()] += weight(out.count) * std::asinh(number);
    ++out.count;
    i += static_cast<std::size_t>(end - rest.c_str());
  }
  return out;
}

inline std::string numbers_text(const TextDigest& d) {
  return fmt::format("{} numbers {:.7g} {:.7g} {:.7g} {:.7g}", d.count, d.sums[0], d.sums[1], d.sums[2],
                     d.sums[3]);
}

/// FNV-1a.
inline std::uint32_t hash_of(std::string_view words) {
  std::uint32_t hash = 2166136261u;
  for (const char c : words) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

}  // namespace ssphh::test
