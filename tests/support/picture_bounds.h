#pragma once
/// Pictures compared where the eye looks: in every channel, at every pixel and in every square of 2, 4, 8 and
/// 16 pixels a side, so that a patch, a step along an edge or a swapped channel shows though the means agree.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/image/image.h>

#include "z_test.h"

namespace ssphh::test {

/// What a picture may show: in every channel between `low` and `high`, but for noise.
struct PictureBounds {
  image::Image low, high;
  image::Image variance;       ///< of the compared difference; empty: there is no noise
  std::vector<bool> left_out;  ///< pixels that are not compared, row by row; empty: all are
  int degrees = 0;             ///< of freedom of the variance, the samples less one; 0: it is known exactly

  bool counts(int x, int y) const { return left_out.empty() || !left_out[y * low.width + x]; }

  /// Around exact values: a share of each and a constant, which a stated approximation may add.
  static PictureBounds around(const image::Image& values, float share, float constant) {
    PictureBounds bounds{values, values, {}, {}};
    for (std::size_t i = 0; i < values.pixels.size(); ++i) {
      const float slack = share * std::abs(values.pixels[i]) + constant;
      bounds.low.pixels[i] -= slack, bounds.high.pixels[i] += slack;
    }
    return bounds;
  }

  /// Where `edge` says so, any value within the bounds of the pixels around will do: what has an edge there
  /// may have it a pixel aside. Returns the share of such pixels, which a test must bound.
  template <class Edge>
  double widen(const Edge& edge) {
    const image::Image least = low, most = high;
    int count = 0;
    for (int y = 0; y < low.height; ++y) {
      for (int x = 0; x < low.width; ++x) {
        if (!edge(x, y)) continue;
        ++count;
        for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, low.height - 1); ++ny) {
          for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, low.width - 1); ++nx) {
            low.set_rgb(x, y, glm::min(low.rgb(x, y), least.rgb(nx, ny)));
            high.set_rgb(x, y, glm::max(high.rgb(x, y), most.rgb(nx, ny)));
          }
        }
      }
    }
    return static_cast<double>(count) / (low.width * low.height);
  }
};

/// Mean and the mean's variance of independent pictures of the same, pixel by pixel.
class PictureSamples {
 public:
  void add(const image::Image& picture) {
    if (samples_.empty()) samples_.resize(picture.pixels.size()), width_ = picture.width;
    for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i].add(static_cast<double>(picture.pixels[i]));
  }
  int degrees() const { return static_cast<int>(samples_.front().count()) - 1; }
  image::Image mean() const {
    return image_of([](const Samples& s) { return s.mean(); });
  }
  image::Image variance() const {
    return image_of([](const Samples& s) { return s.variance_of_mean(); });
  }

 private:
  template <class Value>
  image::Image image_of(const Value& value) const {
    image::Image image(width_, static_cast<int>(samples_.size()) / 3 / width_, 3);
    for (std::size_t i = 0; i < samples_.size(); ++i)
      image.pixels[i] = static_cast<float>(value(samples_[i]));
    return image;
  }
  std::vector<Samples> samples_;
  int width_ = 0;
};

/// Squares of pixels, half a side apart.
template <class Visit>
void for_each_square(int width, int height, const Visit& visit) {
  for (const int side : {1, 2, 4, 8, 16}) {
    const int step = std::max(side / 2, 1);
    for (int y = 0; y + side <= height; y += step) {
      for (int x = 0; x + side <= width; x += step) visit(x, y, side);
    }
  }
}

/// Whether a picture keeps its bounds. `level` is the chance that one which does so but for its noise is
/// refused: of all squares and channels together (Šidák; squares overlap, which makes it less). It holds for
/// samples that are normal; of short-tailed ones, whose t has longer tails than its table, 48 uniform samples
/// were refused 1.5 times (at 5 %) to 3 times (at 0.1 %) as often. Says the worst squares.
inline ::testing::AssertionResult picture_is(const image::Image& picture, const PictureBounds& bounds,
                                             double level = 1e-3) {
  if (picture.width != bounds.low.width || picture.height != bounds.low.height || picture.channels != 3)
    return ::testing::AssertionFailure() << "a picture of another size";
  int squares = 0;
  for_each_square(picture.width, picture.height, [&](int, int, int) { ++squares; });
  const double allowed = Significance{level, 3 * squares}.single();

  struct Found {
    double excess;
    std::string text;
  };
  std::vector<Found> found;
  for_each_square(picture.width, picture.height, [&](int x0, int y0, int side) {
    for (int c = 0; c < 3; ++c) {
      double value = 0, low = 0, high = 0, variance = 0;
      double n = 0;
      for (int i = 0; i < side * side; ++i) n += bounds.counts(x0 + i % side, y0 + i / side);
      if (n == 0) continue;
      for (int i = 0; i < side * side; ++i) {
        const int x = x0 + i % side, y = y0 + i / side;
        if (!bounds.counts(x, y)) continue;
        value += static_cast<double>(picture.at(x, y)[c]) / n;
        low += static_cast<double>(bounds.low.at(x, y)[c]) / n;
        high += static_cast<double>(bounds.high.at(x, y)[c]) / n;
        if (!bounds.variance.empty()) variance += static_cast<double>(bounds.variance.at(x, y)[c]) / (n * n);
      }
      const double rounding = 1e-6 * std::max(std::abs(low), std::abs(high));  // of these sums, in floats
      const double beyond =
          std::isfinite(value) ? std::max({low - value, value - high, 0.0}) - rounding : INFINITY;
      if (beyond <= 0) continue;
      const double z = variance > 0 ? beyond / std::sqrt(variance) : INFINITY;
      if (two_sided_p(z) >= allowed) continue;
      // A square's variance has the degrees of all its pixels
      const double p =
          z < INFINITY && bounds.degrees > 0
              ? 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(bounds.degrees * n), z))
              : two_sided_p(z);
      if (p >= allowed) continue;
      found.push_back(
          {beyond / (std::abs(low) + std::abs(high) + 1e-6),
           fmt::format("{} x {} pixels at ({}, {}), {}: {:.5g}, not {:.5g} to {:.5g}, z {:.3g}", side, side,
                       x0, y0, std::array{"red", "green", "blue"}[c], value, low, high, z)});
    }
  });
  if (found.empty()) return ::testing::AssertionSuccess();
  constexpr std::size_t shown = 6;
  std::ranges::stable_sort(found, [](const Found& a, const Found& b) { return a.excess > b.excess; });
  auto failure = ::testing::AssertionFailure() << found.size() << " squares and channels of " << 3 * squares
                                               << " lie outside of their bounds, the worst:";
  for (std::size_t i = 0; i < std::min(shown, found.size()); ++i) failure << "\n  " << found[i].text;
  return failure;
}

}  // namespace ssphh::test
