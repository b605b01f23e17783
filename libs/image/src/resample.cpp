#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/image/resample.h>

#include "bilinear.h"

namespace ssphh::image {
namespace {

double sinc(double x) {
  return std::abs(x) < 1e-9 ? 1 : std::sin(pi_d * x) / (pi_d * x);
}

constexpr double radii[] = {0.5, 1, 2, 3};  // of the filters in their order

// Weight at distance x in pixels of the coarser image; not for box.
double kernel(Filter filter, double x) {
  x = std::abs(x);
  if (filter == Filter::bilinear) return std::max(0.0, 1 - x);
  if (filter == Filter::lanczos) return x < 3 ? sinc(x) * sinc(x / 3) : 0;
  if (x < 1) return ((21 * x - 36) * x * x + 16) / 18;
  return x < 2 ? (((-7 * x + 36) * x - 60) * x + 32) / 18 : 0;
}

// Old pixels first, first + 1, … of one new pixel, inside the image, with weights that sum to 1.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

Taps taps_of(int i, int from, int to, Filter filter) {
  const double ratio = static_cast<double>(from) / to;
  const double scale = filter == Filter::box ? ratio : std::max(1.0, ratio);
  const double centre = (i + 0.5) * ratio, reach = radii[static_cast<std::size_t>(filter)] * scale;
  const double low = centre - reach, high = centre + reach;
  const int begin = static_cast<int>(std::floor(low)), end = static_cast<int>(std::ceil(high));
  Taps taps;
  taps.first = std::clamp(begin, 0, from - 1);
  std::vector<double> weights(static_cast<std::size_t>(std::clamp(end, taps.first + 1, from) - taps.first),
                              0.0);
  double sum = 0;
  for (int x = begin; x < end; ++x) {
    const double weight = filter == Filter::box
                              ? std::max(0.0, std::min(high, x + 1.0) - std::max(low, static_cast<double>(x)))
                              : kernel(filter, (x + 0.5 - centre) / scale);
    const int inside = std::clamp(x - taps.first, 0, static_cast<int>(weights.size()) - 1);
    weights[inside] += weight;
    sum += weight;
  }
  for (const double weight : weights) taps.weights.push_back(static_cast<float>(weight / sum));
  return taps;
}

std::vector<Taps> all_taps(int from, int to, Filter filter) {
  std::vector<Taps> taps;
  taps.reserve(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) taps.push_back(taps_of(i, from, to, filter));
  return taps;
}

// out(x, y) = Σ weight·in(first + k, y) along rows (step 1 pixel) or columns (step 1 row).
Image filter_axis(const Image& in, int width, int height, const std::vector<Taps>& taps, bool columns) {
  Image out(width, height, in.channels);
  parallel_for(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < width; ++x) {
        const Taps& tap = taps[columns ? y : x];
        float* pixel = out.at(x, y);
        for (std::size_t k = 0; k < tap.weights.size(); ++k) {
          const int place = tap.first + static_cast<int>(k);
          const float* p = columns ? in.at(x, place) : in.at(place, y);
          for (int c = 0; c < in.channels; ++c) pixel[c] += tap.weights[k] * p[c];
        }
      }
    }
  });
  return out;
}

}  // namespace

Image resize(const Image& image, int width, int height, Filter filter) {
  if (image.empty() || width < 1 || height < 1) {
    throw Error("resize", fmt::format("cannot resize {} x {} to {} x {} pixels", image.width, image.height,
                                      width, height));
  }
  require(image.pixels.size() == image.offset(0, image.height), "resize",
          "the image's size and its number of pixels do not agree");
  const Image rows = filter_axis(image, width, image.height, all_taps(image.width, width, filter), false);
  return filter_axis(rows, width, height, all_taps(image.height, height, filter), true);
}

vec3 sample_bilinear(const Image& image, float x, float y) {
  require(!image.empty(), "image", "it is empty");
  return bilinear(BilinearTap(x, y), [&](int i, int j) {
    return image.rgb(std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1));
  });
}

}  // namespace ssphh::image
