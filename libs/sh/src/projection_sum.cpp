#include "projection_sum.h"

#include <utility>

namespace ssphh::sh {
namespace {

// Single-precision lanes are added to the double totals after this many blocks.
constexpr int blocks_per_flush = 512;

double sum_lanes(const float8& v) {
  using float4 = float __attribute__((vector_size(16)));
  using double4 = double __attribute__((vector_size(32)));
  const float4 low = __builtin_shufflevector(v, v, 0, 1, 2, 3),
               high = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  const double4 sum = __builtin_convertvector(low, double4) + __builtin_convertvector(high, double4);
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

// The pack unrolls the tile, so that its sums are registers at every optimisation level.
template <std::size_t... I>
void sum_tile(std::index_sequence<I...>, const CoefficientTile& tile, int blocks, const float8* basis,
              const float8* light, int light_stride, std::array<float8, 3>* sums) {
  const int k[] = {tile.coefficients[I]...};
  float8 red[] = {sums[k[I]][0]...}, green[] = {sums[k[I]][1]...}, blue[] = {sums[k[I]][2]...};
  for (int block = 0; block < blocks; ++block) {
    const float8 r = light[0], g = light[1], b = light[2];
    const auto add = [&](std::size_t i) {
      const float8 y = basis[k[i]];
      red[i] += y * r;
      green[i] += y * g;
      blue[i] += y * b;
    };
    (add(I), ...);
    basis += max_coefficient_count;
    light += light_stride;
  }
  ((sums[k[I]] = {red[I], green[I], blue[I]}), ...);
}

template <std::size_t Count>
void sum_tile_of(const CoefficientTile& tile, int blocks, const float8* basis,
                 const std::vector<float8>& lights, int light_stride, std::array<float8, 3>* sums) {
  sum_tile(std::make_index_sequence<Count>(), tile, blocks, basis, lights.data() + tile.light * 3,
           light_stride, sums);
}

}  // namespace

ProjectionSum::ProjectionSum(int degree, int light_count,
                             const std::array<int, max_coefficient_count>& light_class)
    : degree_(degree),
      light_count_(light_count),
      lights_(static_cast<std::size_t>(blocks_per_pass * light_count * 3)) {
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

void ProjectionSum::sum_pending() {
  const float8* basis = basis_.front().data();
  const int stride = light_count_ * 3;
  for (const CoefficientTile& tile : tiles_) {
    switch (tile.count) {
      case 1:
        sum_tile_of<1>(tile, pending_, basis, lights_, stride, sums_.data());
        break;
      case 2:
        sum_tile_of<2>(tile, pending_, basis, lights_, stride, sums_.data());
        break;
      case 3:
        sum_tile_of<3>(tile, pending_, basis, lights_, stride, sums_.data());
        break;
      default:
        sum_tile_of<4>(tile, pending_, basis, lights_, stride, sums_.data());
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
