#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <ssphh/image/transfer.h>
#include <ssphh/metrics/heat_map.h>

namespace ssphh::metrics {
namespace {

using image::Image;
using image::Rgba8;

vec3 inferno(float t) {
  static constexpr std::array<std::array<float, 3>, 7> c{
      {{0.0002189403691192265f, 0.001651004631001012f, -0.01948089843709184f},
       {0.1065134194856116f, 0.5639564367884091f, 3.932712388889277f},
       {11.60249308247187f, -3.972853965665698f, -15.9423941062914f},
       {-41.70399613139459f, 17.43639888205313f, 44.35414519872813f},
       {77.162935699427f, -33.40235894210092f, -81.80730925738993f},
       {-71.31942824499214f, 32.62606426397723f, 73.20951985803202f},
       {25.13112622477341f, -12.24266895238567f, -23.07032500287172f}}};
  vec3 color(0);
  for (auto k = c.rbegin(); k != c.rend(); ++k) color = color * t + vec3((*k)[0], (*k)[1], (*k)[2]);
  return glm::clamp(color, 0.0f, 1.0f);
}

vec3 diverging(float t) {
  constexpr vec3 blue(0.230f, 0.299f, 0.754f), white(0.865f, 0.865f, 0.865f), red(0.706f, 0.016f, 0.150f);
  return t < 0 ? glm::mix(white, blue, -t) : glm::mix(white, red, t);
}

// Mean of a pixel's channels.
float pixel_value(const Image& map, int x, int y) {
  const float* p = map.at(x, y);
  return map.channels == 1 ? p[0] : (p[0] + p[1] + p[2]) / 3;
}

}  // namespace

vec3 ramp_color(ColorRamp ramp, float value) {
  if (std::isnan(value)) return {1, 0, 1};
  switch (ramp) {
    case ColorRamp::inferno:
      return inferno(std::clamp(value, 0.0f, 1.0f));
    case ColorRamp::diverging:
      return diverging(std::clamp(value, -1.0f, 1.0f));
    case ColorRamp::grey:
      return vec3(std::clamp(value, 0.0f, 1.0f));
  }
  refuse("colour ramp", "there is none of that number");
}

float automatic_scale(const Image& map) {
  image::require_whole(map, "heat map");
  std::vector<float> magnitudes;
  magnitudes.reserve(map.pixels.size() / static_cast<std::size_t>(map.channels));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const float value = std::abs(pixel_value(map, x, y));
      if (std::isfinite(value)) magnitudes.push_back(value);
    }
  }
  if (magnitudes.empty()) return 1;
  const auto rank = magnitudes.begin() + static_cast<std::ptrdiff_t>((magnitudes.size() - 1) * 99 / 100);
  std::nth_element(magnitudes.begin(), rank, magnitudes.end());
  if (*rank > 0) return *rank;
  const float largest = *std::ranges::max_element(magnitudes);
  return largest > 0 ? largest : 1;
}

Rgba8 heat_map(const Image& map, ColorRamp ramp, float scale) {
  image::require_whole(map, "heat map");
  require(std::isfinite(scale), "heat map", "its scale must be a number");
  if (scale <= 0) scale = automatic_scale(map);
  Rgba8 out{map.width, map.height, {}};
  out.rgba.reserve(std::size_t{4} * static_cast<std::size_t>(map.width) *
                   static_cast<std::size_t>(map.height));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const vec3 color = ramp_color(ramp, pixel_value(map, x, y) / scale);
      for (int c = 0; c < 3; ++c) out.rgba.push_back(image::unit_to_8bit(color[c]));
      out.rgba.push_back(255);
    }
  }
  return out;
}

Image enlarge_blocks(const Image& pixelated, int block, int width, int height) {
  require(block >= 1 && width >= 1 && height >= 1 && (width - 1) / block < pixelated.width &&
              (height - 1) / block < pixelated.height,
          "pixelated map", "its blocks do not cover the picture");
  Image out(width, height, pixelated.channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::copy_n(pixelated.at(x / block, y / block), pixelated.channels, out.at(x, y));
    }
  }
  return out;
}

}  // namespace ssphh::metrics
