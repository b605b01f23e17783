#include "projection_sum.h"

#include <algorithm>

namespace ssphh::sh {
namespace {

// Single-precision lanes are added to the double totals after this many blocks.
constexpr int blocks_per_flush = 256;

template <int Count>
void sum_tile(const CoefficientTile& tile, int blocks, const float8* basis, const float8* lights,
              int light_stride, std::array<float8, 3>* sums) {
  float8 sum[Count][3];
  for (int i = 0; i < Count; ++i) {
    for (int c = 0; c < 3; ++c)
      sum[i][c] = sums[tile.coefficients[static_cast<std::size_t>(i)]][static_cast<std::size_t>(c)];
  }
  const float8* light = lights + tile.light * 3;
  for (int b = 0; b < blocks; ++b) {
    const float8 r = light[0], g = light[1], blue = light[2];
    for (int i = 0; i < Count; ++i) {
      const float8 y = basis[tile.coefficients[static_cast<std::size_t>(i)]];
      sum[i][0] += y * r;
      sum[i][1] += y * g;
      sum[i][2] += y * blue;
    }
    basis += max_coefficient_count;
    light += light_stride;
  }
  for (int i = 0; i < Count; ++i) {
    for (int c = 0; c < 3; ++c)
      sums[tile.coefficients[static_cast<std::size_t>(i)]][static_cast<std::size_t>(c)] = sum[i][c];
  }
}

}  // namespace

ProjectionSum::ProjectionSum(int degree, int light_count,
                             const std::array<int, max_coefficient_count>& light_class)
    : degree_(degree),
      light_count_(light_count),
      lights_(static_cast<std::size_t>(blocks_per_pass * light_count * 3)) {
  SSPHH_CHECK(degree >= 0 && degree <= max_degree);
  for (int light = 0; light < light_count; ++light) {
    CoefficientTile tile{.light = light};
    for (int k = 0; k < coefficient_count(degree); ++k) {
      if (light_class[static_cast<std::size_t>(k)] != light) continue;
      tile.coefficients[static_cast<std::size_t>(tile.count++)] = k;
      if (tile.count == 4) {
        tiles_.push_back(tile);
        tile.count = 0;
      }
    }
    if (tile.count > 0) tiles_.push_back(tile);
  }
  for (auto& sum : sums_) sum = {};
}

void ProjectionSum::sum_pending() {
  const float8* basis = basis_.front().data();
  const int stride = light_count_ * 3;
  for (const CoefficientTile& tile : tiles_) {
    switch (tile.count) {
      case 1:
        sum_tile<1>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
      case 2:
        sum_tile<2>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
      case 3:
        sum_tile<3>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
      default:
        sum_tile<4>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
    }
  }
  summed_ += pending_;
  pending_ = 0;
  if (summed_ >= blocks_per_flush) flush();
}

void ProjectionSum::flush() {
  for (std::size_t k = 0; k < static_cast<std::size_t>(coefficient_count(degree_)); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      double total = 0;
      for (int i = 0; i < lane_count; ++i) total += static_cast<double>(sums_[k][c][i]);
      totals_[k][static_cast<int>(c)] += total;
      sums_[k][c] = float8{};
    }
  }
  summed_ = 0;
}

RadianceSh ProjectionSum::result() {
  sum_pending();
  flush();
  RadianceSh sh(degree_);
  for (int k = 0; k < coefficient_count(degree_); ++k) sh[k] = vec3(totals_[static_cast<std::size_t>(k)]);
  return sh;
}

}  // namespace ssphh::sh
