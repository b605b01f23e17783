#include "comparison.h"

#include <ssphh/metrics/heat_map.h>

namespace ssphh::viewer {
namespace {

Difference colored(const image::Image& map, metrics::ColorRamp ramp) {
  Difference out;
  out.scale = metrics::automatic_scale(map);
  out.picture = metrics::heat_map(map, ramp, out.scale);
  return out;
}

}  // namespace

Difference difference(const image::Image& truth, const image::Image& realtime, Show show, int block) {
  Difference out;
  if (show == Show::signed_) {
    out = colored(metrics::signed_error_map(truth, realtime), metrics::ColorRamp::diverging);
  } else if (show == Show::pixelated) {
    const image::Image blocks = metrics::pixelated_error_map(truth, realtime, block);
    out = colored(metrics::enlarge_blocks(blocks, block, truth.width, truth.height),
                  metrics::ColorRamp::inferno);
  } else {
    out = colored(metrics::absolute_error_map(truth, realtime), metrics::ColorRamp::inferno);
  }
  out.error = metrics::compare(truth, realtime);
  return out;
}

Difference leak_picture(const image::Image& truth_indirect, const image::Image& realtime_indirect) {
  double sum = 0;
  for (int y = 0; y < truth_indirect.height; ++y) {
    for (int x = 0; x < truth_indirect.width; ++x)
      sum += static_cast<double>(luminance(truth_indirect.rgb(x, y)));
  }
  const double pixels = static_cast<double>(truth_indirect.width) * truth_indirect.height;
  const auto dark = static_cast<float>(1e-3 * sum / pixels);
  image::Image leak(truth_indirect.width, truth_indirect.height);
  for (int y = 0; y < leak.height; ++y) {
    for (int x = 0; x < leak.width; ++x) {
      if (luminance(truth_indirect.rgb(x, y)) <= dark) leak.set_rgb(x, y, realtime_indirect.rgb(x, y));
    }
  }
  Difference out = colored(leak, metrics::ColorRamp::inferno);
  out.error = metrics::compare(truth_indirect, realtime_indirect);
  return out;
}

}  // namespace ssphh::viewer
