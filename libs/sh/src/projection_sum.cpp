#include "projection_sum.h"

namespace ssphh::sh {
namespace {

double sum_lanes(const float8& v) {
  using float4 = float __attribute__((vector_size(16)));
  using double4 = double __attribute__((vector_size(32)));
  const float4 low = __builtin_shufflevector(v, v, 0, 1, 2, 3),
               high = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  const double4 sum = __builtin_convertvector(low, double4) + __builtin_convertvector(high, double4);
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace

ProjectionSum::ProjectionSum(int degree, int light_count,
                             const std::array<int, max_coefficient_count>& light_class)
    : degree_(degree), light_count_(light_count) {
  require_degree(degree, "projection");
  for (int light = 0; light < light_count; ++light) {
    CoefficientTile tile{.light = light};
    for (int k = 0; k < coefficient_count(degree); ++k) {
      if (light_class[k] != light) continue;
      tile.coefficients[tile.count++] = k;
      if (tile.count == 4) {
        tiles_.push_back(tile);
        tile.count = 0;
      }
    }
    if (tile.count > 0) tiles_.push_back(tile);
  }
  for (auto& sum : sums_) sum = {};
}

void ProjectionSum::flush() {
  for (std::size_t k = 0; k < static_cast<std::size_t>(coefficient_count(degree_)); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      totals_[k][static_cast<int>(c)] += sum_lanes(sums_[k][c]);
      sums_[k][c] = float8{};
    }
  }
  summed_ = 0;
}

RadianceSh ProjectionSum::result() {
  sum_pending();
  flush();
  RadianceSh sh(degree_);
  for (int k = 0; k < coefficient_count(degree_); ++k) sh[k] = vec3(totals_[k]);
  return sh;
}

}  // namespace ssphh::sh
