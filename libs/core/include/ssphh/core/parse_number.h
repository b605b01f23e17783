#pragma once
/// Numbers that people write.

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ssphh {

/// The decimal number that the whole text is, in whatever locale: "12", "-0.5", "1e-3". None where anything
/// else stands in it, be it a space or a plus sign, or where it does not fit `Number`; infinities and NaN are
/// none.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(number)) return std::nullopt;
  }
  return number;
}

/// The numbers of a text like "0,2.5,-1"; none where one of them is no number.
std::optional<std::vector<float>> parse_numbers(std::string_view text);

}  // namespace ssphh
