#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <ssphh/core/parallel.h>
#include <ssphh/image/transfer.h>
#include <ssphh/metrics/perceptual.h>

#include "check_size.h"

namespace ssphh::metrics {
namespace {

using image::Image;

constexpr int window = 11;
constexpr double sigma = 1.5, c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;

vec3 encoded(const vec3& linear) {
  vec3 out;
  for (int c = 0; c < 3; ++c) out[c] = image::linear_to_srgb(std::clamp(linear[c], 0.0f, 1.0f));
  return out;
}

// Weights of min(window, size) pixels, adding up to 1.
std::vector<double> window_weights(int size) {
  const int taps = std::min(window, size);
  std::vector<double> weights;
  double sum = 0;
  for (int i = 0; i < taps; ++i) {
    const double x = i - (taps - 1) / 2.0;
    weights.push_back(std::exp(-x * x / (2 * sigma * sigma)));
    sum += weights.back();
  }
  for (double& w : weights) w /= sum;
  return weights;
}

// Luma of both images and their products: what SSIM takes window means of.
using Moments = std::array<double, 5>;

Moments moments(double r, double t) {
  return {r, t, r * r, t * t, r * t};
}

double similarity(const Moments& m) {
  const double variance_r = m[2] - m[0] * m[0], variance_t = m[3] - m[1] * m[1],
               covariance = m[4] - m[0] * m[1];
  return (2 * m[0] * m[1] + c1) * (2 * covariance + c2) /
         ((m[0] * m[0] + m[1] * m[1] + c1) * (variance_r + variance_t + c2));
}

struct Luma {
  int width, height;
  std::vector<double> reference, test;  // NaN in both where a pixel is not finite in one
};

// Mean over the windows: rows are blurred along x first, so a row of windows costs two passes.
double mean_similarity(const Luma& luma) {
  const std::vector<double> wx = window_weights(luma.width), wy = window_weights(luma.height);
  const auto columns = static_cast<std::size_t>(luma.width) - wx.size() + 1;
  const auto rows = static_cast<std::size_t>(luma.height) - wy.size() + 1;
  std::vector<Moments> blurred(columns * static_cast<std::size_t>(luma.height));
  parallel_for(static_cast<std::size_t>(luma.height), 8, [&](std::size_t y) {
    for (std::size_t x = 0; x < columns; ++x) {
      Moments& sum = blurred[y * columns + x];
      for (std::size_t i = 0; i < wx.size(); ++i) {
        const std::size_t p = y * static_cast<std::size_t>(luma.width) + x + i;
        const Moments m = moments(luma.reference[p], luma.test[p]);
        for (std::size_t k = 0; k < m.size(); ++k) sum[k] += wx[i] * m[k];
      }
    }
  });
  struct Row {
    double sum = 0;
    std::size_t windows = 0;
  };
  std::vector<Row> totals(rows);
  parallel_for(rows, 8, [&](std::size_t y) {
    for (std::size_t x = 0; x < columns; ++x) {
      Moments sum{};
      for (std::size_t i = 0; i < wy.size(); ++i) {
        const Moments& m = blurred[(y + i) * columns + x];
        for (std::size_t k = 0; k < m.size(); ++k) sum[k] += wy[i] * m[k];
      }
      const double s = similarity(sum);
      if (!std::isnan(s)) totals[y].sum += s, ++totals[y].windows;
    }
  });
  Row all;
  for (const Row& row : totals) all.sum += row.sum, all.windows += row.windows;
  return all.windows > 0 ? all.sum / static_cast<double>(all.windows) : 1;
}

}  // namespace

DisplayError display_error(const Image& reference, const Image& test) {
  check_same_size(reference, test);
  Luma luma{reference.width, reference.height, {}, {}};
  double squared = 0;
  std::size_t finite = 0;
  for (int y = 0; y < luma.height; ++y) {
    for (int x = 0; x < luma.width; ++x) {
      vec3 r = reference.rgb(x, y), t = test.rgb(x, y);
      if (!is_finite(r) || !is_finite(t)) {
        luma.reference.push_back(std::numeric_limits<double>::quiet_NaN());
        luma.test.push_back(std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      r = encoded(r), t = encoded(t);
      for (int c = 0; c < 3; ++c) squared += double{t[c] - r[c]} * double{t[c] - r[c]};
      ++finite;
      constexpr vec3 weights(0.2126f, 0.7152f, 0.0722f);
      luma.reference.push_back(double{glm::dot(weights, r)});
      luma.test.push_back(double{glm::dot(weights, t)});
    }
  }
  DisplayError error;
  error.psnr = squared > 0 ? -10 * std::log10(squared / (3 * static_cast<double>(finite)))
                           : std::numeric_limits<double>::infinity();
  error.ssim = mean_similarity(luma);
  return error;
}

}  // namespace ssphh::metrics
