#include "lamp_color.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/math.h>

namespace ssphh::viewer {
namespace {

float encoded(float linear) {
  const float v = std::clamp(linear, 0.0f, 1.0f);
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

float decoded(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

vec2 chromaticity_of_kelvin(float kelvin) {
  const float t = 1000 / std::clamp(kelvin, least_kelvin, most_kelvin);
  const float x = kelvin < 4000 ? ((-0.2661239f * t - 0.2343589f) * t + 0.8776956f) * t + 0.179910f
                                : ((-3.0258469f * t + 2.1070379f) * t + 0.2226347f) * t + 0.240390f;
  const float y = kelvin < 2222   ? ((-1.1063814f * x - 1.34811020f) * x + 2.18555832f) * x - 0.20219683f
                  : kelvin < 4000 ? ((-0.9549476f * x - 1.37418593f) * x + 2.09137015f) * x - 0.16748867f
                                  : ((3.0817580f * x - 5.87338670f) * x + 3.75112997f) * x - 0.37001483f;
  return {x, y};
}

}  // namespace

std::string hex_of(const vec3& linear) {
  const auto byte = [&](int c) { return static_cast<int>(std::lround(255 * encoded(linear[c]))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
}

std::optional<vec3> color_of_hex(const std::string& text) {
  const std::string digits = text.starts_with('#') ? text.substr(1) : text;
  if (digits.size() != 3 && digits.size() != 6) return {};
  if (std::ranges::any_of(digits, [](char c) { return digit(c) < 0; })) return {};
  vec3 out;
  for (std::size_t c = 0; c < 3; ++c) {
    const int value =
        digits.size() == 3 ? 17 * digit(digits[c]) : 16 * digit(digits[2 * c]) + digit(digits[2 * c + 1]);
    out[static_cast<int>(c)] = decoded(static_cast<float>(value) / 255);
  }
  return out;
}

vec3 color_of_kelvin(float kelvin) {
  const vec2 xy = chromaticity_of_kelvin(kelvin);
  const float x = xy.x / xy.y, z = (1 - xy.x - xy.y) / xy.y;
  const vec3 rgb(3.2404542f * x - 1.5371385f - 0.4985314f * z, -0.9692660f * x + 1.8760108f + 0.0415560f * z,
                 0.0556434f * x - 0.2040259f + 1.0572252f * z);
  return glm::max(rgb, vec3(0)) / std::max({rgb.x, rgb.y, rgb.z});
}

std::optional<float> kelvin_of(const vec3& c) {
  const float x = 0.4124564f * c.x + 0.3575761f * c.y + 0.1804375f * c.z,
              y = 0.2126729f * c.x + 0.7151522f * c.y + 0.0721750f * c.z,
              z = 0.0193339f * c.x + 0.1191920f * c.y + 0.9503041f * c.z;
  const float sum = x + y + z;
  if (!(sum > 0)) return {};
  // Below, bluer than any black body, the formula has a pole.
  if (y / sum < 0.2f) return most_kelvin;
  const float n = (x / sum - 0.3320f) / (0.1858f - y / sum);
  const float kelvin = ((449 * n + 3525) * n + 6823.3f) * n + 5520.33f;
  return std::isfinite(kelvin) ? std::clamp(kelvin, least_kelvin, most_kelvin) : least_kelvin;
}

}  // namespace ssphh::viewer
