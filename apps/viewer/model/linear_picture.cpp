#include "linear_picture.h"

#include <algorithm>
#include <functional>

#include <ssphh/core/require.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/heat_map.h>

namespace ssphh::viewer {

void LinearMean::add(const image::Image& picture) {
  if (count_++ == 0) {
    sum_ = picture;
    return;
  }
  SSPHH_CHECK(sum_.pixels.size() == picture.pixels.size());
  std::ranges::transform(sum_.pixels, picture.pixels, sum_.pixels.begin(), std::plus<>());
}

image::Image LinearMean::mean() const {
  image::Image out = sum_;
  for (float& value : out.pixels) value /= static_cast<float>(count_);
  return out;
}

std::optional<image::Image> linear_shown(const Settings& settings, const image::Image& realtime,
                                         const ReferenceImage& truth) {
  if (settings.show == Show::realtime) return realtime;
  if (!truth.color || truth.color->width != realtime.width || truth.color->height != realtime.height)
    return {};
  const image::Image& color = *truth.color;
  if (settings.show == Show::truth) return color;
  if (settings.show == Show::absolute) return metrics::absolute_error_map(color, realtime);
  if (settings.show == Show::signed_) return metrics::signed_error_map(color, realtime);
  if (settings.show == Show::pixelated)
    return metrics::enlarge_blocks(metrics::pixelated_error_map(color, realtime, settings.block),
                                   settings.block, color.width, color.height);
  image::Image out = realtime;
  const auto from = static_cast<int>(settings.wipe * static_cast<float>(out.width));
  for (int y = 0; y < out.height; ++y) {
    for (int x = from; x < out.width; ++x) out.set_rgb(x, y, color.rgb(x, y));
  }
  return out;
}

}  // namespace ssphh::viewer
