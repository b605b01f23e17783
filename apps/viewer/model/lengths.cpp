#include "lengths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace ssphh::viewer {
namespace {

/// Where the first digit stands: 0 of 3, −2 of 0.03.
int place_of_first_digit(float length) {
  return static_cast<int>(std::floor(std::log10(std::max(length, 1e-9f))));
}

}  // namespace

Lengths lengths_of(const scene::Bounds& bounds) {
  constexpr float room = 5;
  const float radius = bounds.empty() || !(bounds.radius() > 0) ? room : bounds.radius();
  const int place = place_of_first_digit(0.004f * radius);
  const float step = std::pow(10.0f, static_cast<float>(place));
  return {std::min(0.1f, 0.04f * radius), step, std::clamp(-place, 2, 8)};
}

float snap_step(const Lengths& lengths) {
  return 10 * lengths.step;
}

const char* length_format(int decimals) {
  constexpr std::array<const char*, 10> formats = {"%.0f", "%.1f", "%.2f", "%.3f", "%.4f",
                                                   "%.5f", "%.6f", "%.7f", "%.8f", "%.9f"};
  return formats.at(static_cast<std::size_t>(std::clamp(decimals, 0, 9)));
}

std::string length_text(float length, float scale) {
  const int decimals = std::clamp(3 - place_of_first_digit(scale), 0, 9);
  const std::string text = fmt::format("{:.{}f}", length, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.starts_with('-') ? text.substr(1) : text;
}

}  // namespace ssphh::viewer
