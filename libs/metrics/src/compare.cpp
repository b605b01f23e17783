#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/metrics/compare.h>

#include "check_size.h"

namespace ssphh::metrics {
namespace {

using image::Image;
using dvec3 = glm::dvec3;

bool both_grey(const Image& reference, const Image& test) {
  return reference.channels == 1 && test.channels == 1;
}

// Sums over the channels of finite pixels.
struct Sums {
  std::uint64_t pixels = 0, nonfinite = 0;
  double absolute = 0, difference = 0, squared = 0, relative_squared = 0, relative = 0, symmetric = 0,
         max = 0;
  dvec3 reference{0}, test{0};

  void add(const vec3& r, const vec3& t, int channels) {
    if (!is_finite(r) || !is_finite(t)) {
      ++nonfinite;
      return;
    }
    ++pixels;
    for (int c = 0; c < channels; ++c) {
      const double rc = double{r[c]}, d = double{t[c]} - rc;
      absolute += std::abs(d), difference += d, squared += d * d;
      relative_squared += d * d / (rc * rc + relative_epsilon);
      relative += std::abs(d) / (std::abs(rc) + relative_epsilon);
      symmetric += std::abs(d) / (std::abs(rc) + std::abs(double{t[c]}) + relative_epsilon);
      max = std::max(max, std::abs(d));
    }
    reference += dvec3(r), test += dvec3(t);
  }
  void add(const Sums& s) {
    pixels += s.pixels, nonfinite += s.nonfinite;
    absolute += s.absolute, difference += s.difference, squared += s.squared;
    relative_squared += s.relative_squared, relative += s.relative, symmetric += s.symmetric;
    max = std::max(max, s.max);
    reference += s.reference, test += s.test;
  }
};

// Sums of each row, then of the rows in order.
Sums sum_rows(const Image& reference, const Image& test, int channels) {
  std::vector<Sums> rows(static_cast<std::size_t>(reference.height));
  parallel_for(rows.size(), 16, [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < reference.width; ++x) rows[row].add(reference.rgb(x, y), test.rgb(x, y), channels);
  });
  Sums total;
  for (const Sums& row : rows) total.add(row);
  return total;
}

// One output value per channel from f(reference, test).
template <class Error>
Image error_map(const Image& reference, const Image& test, const Error& f) {
  check_same_size(reference, test);
  const int channels = both_grey(reference, test) ? 1 : 3;
  Image map(reference.width, reference.height, channels);
  parallel_for(static_cast<std::size_t>(map.height), 16, [&](std::size_t begin, std::size_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < map.width; ++x) {
        const vec3 r = reference.rgb(x, y), t = test.rgb(x, y);
        const bool finite = is_finite(r) && is_finite(t);
        for (int c = 0; c < channels; ++c) {
          map.at(x, y)[c] = finite ? f(r[c], t[c]) : std::numeric_limits<float>::quiet_NaN();
        }
      }
    }
  });
  return map;
}

}  // namespace

ImageError compare(const Image& reference, const Image& test) {
  check_same_size(reference, test);
  const int channels = both_grey(reference, test) ? 1 : 3;
  const Sums sums = sum_rows(reference, test, channels);
  ImageError error;
  error.width = reference.width, error.height = reference.height;
  error.pixels = sums.pixels, error.nonfinite_pixels = sums.nonfinite;
  for (int c = 0; c < 3; ++c) {
    error.mean_ratio[c] =
        sums.reference[c] != 0 ? sums.test[c] / sums.reference[c] : std::numeric_limits<double>::quiet_NaN();
  }
  if (sums.pixels == 0) return error;
  const double count = static_cast<double>(sums.pixels) * channels;
  error.sum = sums.absolute;
  error.max = sums.max;
  error.mae = sums.absolute / count;
  error.bias = sums.difference / count;
  error.mse = sums.squared / count;
  error.rmse = std::sqrt(error.mse);
  error.relmse = sums.relative_squared / count;
  error.mape = sums.relative / count;
  error.smape = sums.symmetric / count;
  return error;
}

Image absolute_error_map(const Image& reference, const Image& test) {
  return error_map(reference, test, [](float r, float t) { return std::abs(t - r); });
}

Image signed_error_map(const Image& reference, const Image& test) {
  return error_map(reference, test, [](float r, float t) { return t - r; });
}

Image relative_squared_error_map(const Image& reference, const Image& test) {
  return error_map(reference, test, [](float r, float t) {
    const double d = double{t} - double{r};
    return static_cast<float>(d * d / (double{r} * double{r} + relative_epsilon));
  });
}

Image pixelated_error_map(const Image& reference, const Image& test, int block) {
  if (block < 1)
    throw Error("compare", fmt::format("blocks of {} pixels are impossible", block), "use 1 or more");
  const Image absolute = absolute_error_map(reference, test);
  const int columns = (absolute.width - 1) / block + 1, rows = (absolute.height - 1) / block + 1;
  Image map(columns, rows, absolute.channels);
  parallel_for(static_cast<std::size_t>(rows), 1, [&](std::size_t begin, std::size_t end) {
    const auto channels = static_cast<std::size_t>(absolute.channels);
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      std::vector<double> sums(static_cast<std::size_t>(columns) * channels, 0.0);
      const int first = row * block, last = first + std::min(block, absolute.height - first);
      for (int y = first; y < last; ++y) {
        for (int x = 0; x < absolute.width; ++x) {
          for (std::size_t c = 0; c < channels; ++c) {
            const float value = absolute.at(x, y)[c];
            if (!std::isnan(value)) sums[static_cast<std::size_t>(x / block) * channels + c] += double{value};
          }
        }
      }
      std::ranges::transform(sums, map.at(0, row), [](double s) { return static_cast<float>(s); });
    }
  });
  return map;
}

BlockError block_error(const Image& pixelated, int block) {
  image::require_whole(pixelated, "pixelated map");
  BlockError error{block, pixelated.width, pixelated.height, -1, 0, 0, 0};
  for (int y = 0; y < pixelated.height; ++y) {
    for (int x = 0; x < pixelated.width; ++x) {
      double sum = 0;
      for (int c = 0; c < pixelated.channels; ++c) sum += double{pixelated.at(x, y)[c]};
      error.mean += sum;
      if (sum > error.max) error.max = sum, error.max_column = x, error.max_row = y;
    }
  }
  error.mean /= static_cast<double>(pixelated.width) * pixelated.height;
  return error;
}

}  // namespace ssphh::metrics
