#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <ssphh/image/exposure.h>

namespace ssphh::image {
namespace {

/// Luminance of the pixels that are lit.
std::vector<float> lit(const Image& image) {
  std::vector<float> out;
  out.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float light = luminance(image.rgb(x, y));
      if (light >= std::numeric_limits<float>::min() && std::isfinite(light)) out.push_back(light);
    }
  }
  return out;
}

/// The value that a share of all does not exceed.
float quantile(std::vector<float>& values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace

float automatic_exposure(const Image& image, ToneCurve curve) {
  require_whole(image, "automatic exposure");
  std::vector<float> light = lit(image);
  if (light.empty()) return 0;

  // In units of a power of two near the median, so that brighter light shifts the result by exactly as much.
  int unit = 0;
  std::frexp(quantile(light, 0.5), &unit);
  for (float& x : light) x = std::ldexp(x, -unit);

  const float high = quantile(light, 0.95), highlights = quantile(light, 0.98);
  const float low = std::max(quantile(light, 0.05), high / 256);  // deeper shadows are black in any picture
  // Whole numbers, whose sum knows no order.
  constexpr double steps = 65536;
  std::int64_t sum = 0;
  for (const float x : light)
    sum += std::llround(steps * std::log2(static_cast<double>(std::clamp(x, low, high))));
  const double mean = static_cast<double>(sum) / (steps * static_cast<double>(light.size()));

  constexpr double middle_grey = 0.18, white = 0.9;
  const double grey = std::log2(middle_grey) - mean;
  const double unburnt = std::log2(white) - std::log2(static_cast<double>(highlights));
  // Half a stop saves what burns out by less; what burns out by a stop and more is lost either way
  const double burnt = grey - unburnt, held = std::max(std::min(burnt, 1 - burnt), 0.0);
  const double clipped = burnt > 0 ? grey - held : std::min(unburnt, grey + 0.75);
  double ev = clipped;
  if (curve != ToneCurve::clip) {
    // The mean is shown as bright as clip shows it.
    const auto shown = static_cast<float>(std::exp2(mean + clipped));
    ev = std::log2(static_cast<double>(light_shown_as(curve, shown))) - mean;
  }
  return static_cast<float>(std::round(4 * ev) / 4 - unit);
}

}  // namespace ssphh::image
