#include "reading.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/math.h>

namespace ssphh::viewer {
namespace {

constexpr float middle_grey = 0.18f;

/// Where among the bins; below 0 or NaN: darker than all.
float bin_of(float stops) {
  return (stops + farthest_stop + 0.5f) * bins_per_stop;
}

}  // namespace

float stops_of(float luminance, float exposure) {
  return std::log2(std::max(luminance, 0.0f) / middle_grey) + exposure;
}

float luminance_at(float stops, float exposure) {
  return middle_grey * std::exp2(stops - exposure);
}

StopHistogram stop_histogram(const image::Image& radiance, float exposure) {
  StopHistogram out;
  constexpr std::size_t enough = 250'000;
  const std::size_t pixels =
      static_cast<std::size_t>(radiance.width) * static_cast<std::size_t>(radiance.height);
  // An odd step meets other columns in each row.
  const std::size_t step = (pixels / enough) | 1;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < pixels; i += step, ++counted) {
    const auto width = static_cast<std::size_t>(radiance.width);
    const float stops =
        stops_of(luminance(radiance.rgb(static_cast<int>(i % width), static_cast<int>(i / width))), exposure);
    const float at = bin_of(stops);
    if (!(at >= 0)) {
      ++out.darker;
    } else if (at >= static_cast<float>(out.bins.size())) {
      ++out.brighter;
    } else {
      ++out.bins[at];
    }
  }
  const float share = counted > 0 ? 1 / static_cast<float>(counted) : 0;
  for (float& bin : out.bins) bin *= share;
  out.darker *= share, out.brighter *= share;
  return out;
}

Waveform waveform(const image::Image& radiance, float exposure) {
  Waveform out;
  if (radiance.empty()) return out;
  constexpr int enough = 250'000;
  const int width = radiance.width, height = radiance.height;
  const int step = static_cast<int>(static_cast<std::int64_t>(width) * height / enough) + 1;
  for (int column = 0; column < waveform_columns; ++column) {
    const auto edge = [&](int c) {
      return static_cast<int>(static_cast<std::int64_t>(c) * width / waveform_columns);
    };
    const int from = edge(column), to = std::max(edge(column + 1), from + 1);
    const float share = 1 / static_cast<float>((to - from) * ((height + step - 1) / step));
    for (int y = 0; y < height; y += step) {
      for (int x = from; x < to; ++x) {
        const vec3 light = radiance.rgb(x, y);
        for (int c = 0; c < 3; ++c) {
          const float at = bin_of(stops_of(light[c], exposure));
          const auto bin = at >= 0 ? std::min(at, static_cast<float>(stop_bins - 1)) : 0.0f;
          out.channels[static_cast<std::size_t>(c)][static_cast<std::size_t>(column)]
                      [static_cast<std::size_t>(bin)] += share;
        }
      }
    }
  }
  return out;
}

Waveform wiped(Waveform left, const Waveform& right, float line) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t column = 0; column < waveform_columns; ++column) {
      if ((static_cast<float>(column) + 0.5f) / waveform_columns >= line)
        left.channels[c][column] = right.channels[c][column];
    }
  }
  return left;
}

std::array<std::uint8_t, 3> color_of_stop(int stop) {
  if (stop < -farthest_stop) return {0, 0, 0};
  if (stop > farthest_stop) return {255, 255, 255};
  if (stop == 0) return {128, 128, 128};
  // Hues from violet over blue, green and yellow to red; every other one is darker, so that neighbours
  // differ.
  const float t = static_cast<float>(stop + farthest_stop) / (stop_bands - 1);
  const float hue = 4.6f * (1 - t), value = stop % 2 == 0 ? 1.0f : 0.72f;
  const auto channel = [&](float center) {
    const float far = std::abs(hue - center);
    const float share = std::clamp(2 - std::min(far, 6 - far), 0.0f, 1.0f);
    return static_cast<std::uint8_t>(std::lround(255 * value * (0.12f + 0.88f * share)));
  };
  return {channel(0), channel(2), channel(4)};
}

image::Rgba8 false_color(const image::Image& radiance, float exposure) {
  image::Rgba8 out{radiance.width, radiance.height, {}};
  out.rgba.reserve(4 * static_cast<std::size_t>(radiance.width) * static_cast<std::size_t>(radiance.height));
  for (int y = 0; y < radiance.height; ++y) {
    for (int x = 0; x < radiance.width; ++x) {
      const float stops = stops_of(luminance(radiance.rgb(x, y)), exposure);
      // NaN is dark, too.
      const float band = stops > -100 ? std::min(std::round(stops), 100.0f) : -100;
      const auto color = color_of_stop(static_cast<int>(band));
      out.rgba.insert(out.rgba.end(), {color[0], color[1], color[2], 255});
    }
  }
  return out;
}

std::string stop_text(int stop) {
  return stop < 0 ? fmt::format("−{}", -stop) : stop > 0 ? fmt::format("+{}", stop) : "0";
}

}  // namespace ssphh::viewer
