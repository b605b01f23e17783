#pragma once
/// The inner loop of every projection: sums[k][c] += Σ_blocks basis[k] · light[class(k)][c], eight directions
/// per block, as a small matrix product whose accumulators stay in registers. What for_this_cpu() runs of it
/// stands here.

#include <array>
#include <utility>
#include <vector>

#include "recurrence.h"

namespace ssphh::sh {

/// Up to four coefficients that read the same light.
struct CoefficientTile {
  int count = 0;
  std::array<int, 4> coefficients{};
  int light = 0;
};

/// Blocks summed by one pass: their basis values stay in the L1 cache.
inline constexpr int blocks_per_pass = 4;
/// Single-precision lanes are added to the double totals after this many blocks.
inline constexpr int blocks_per_flush = 512;
/// The even and odd sums of the cube's octants.
inline constexpr int max_light_count = 8;

/// The pack unrolls the tile, so that its sums are registers at every optimisation level.
template <std::size_t... I>
SSPHH_IN_LOOP inline void sum_tile(std::index_sequence<I...>, const CoefficientTile& tile, int blocks,
                                   const float8* basis, const float8* light, int light_stride,
                                   std::array<float8, 3>* sums) {
  const int k[] = {tile.coefficients[I]...};
  float8 red[] = {sums[k[I]][0]...}, green[] = {sums[k[I]][1]...}, blue[] = {sums[k[I]][2]...};
  for (int block = 0; block < blocks; ++block) {
    const float8 r = light[0], g = light[1], b = light[2];
    const auto add = [&](std::size_t i) SSPHH_IN_LOOP {
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
SSPHH_IN_LOOP inline void sum_tile_of(const CoefficientTile& tile, int blocks, const float8* basis,
                                      const float8* lights, int light_stride, std::array<float8, 3>* sums) {
  sum_tile(std::make_index_sequence<Count>(), tile, blocks, basis, lights + tile.light * 3, light_stride,
           sums);
}

class ProjectionSum {
 public:
  /// `light_class[k]` < light_count ≤ max_light_count says which light coefficient k reads.
  ProjectionSum(int degree, int light_count, const std::array<int, max_coefficient_count>& light_class);

  /// Slot for the next block. The caller fills basis (by direction) and light, weights included.
  SSPHH_IN_LOOP void add_direction_block(const float8& x, const float8& y, const float8& z) {
    eval_recurrence(table_, degree_, x, y, z, basis_[pending_].data());
  }
  /// [light_count][3] of the block whose directions were just given.
  SSPHH_IN_LOOP float8* light() { return lights_.data() + pending_ * light_count_ * 3; }
  SSPHH_IN_LOOP void finish_block() {
    if (++pending_ == blocks_per_pass) sum_pending();
  }

  RadianceSh result();

 private:
  SSPHH_IN_LOOP void sum_pending();
  void flush();

  int degree_, light_count_, pending_ = 0, summed_ = 0;
  const RecurrenceTable<float>& table_ = recurrence_table_float();
  std::vector<CoefficientTile> tiles_;
  // Aligned for AVX, whichever version reads them.
  alignas(32) std::array<std::array<float8, max_coefficient_count>, blocks_per_pass> basis_;
  alignas(32) std::array<float8, blocks_per_pass * max_light_count * 3> lights_;
  alignas(32) std::array<std::array<float8, 3>, max_coefficient_count> sums_;
  std::array<glm::dvec3, max_coefficient_count> totals_{};
};

SSPHH_IN_LOOP inline void ProjectionSum::sum_pending() {
  const float8* basis = basis_.front().data();
  const int stride = light_count_ * 3;
  for (const CoefficientTile& tile : tiles_) {
    switch (tile.count) {
      case 1:
        sum_tile_of<1>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
      case 2:
        sum_tile_of<2>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
      case 3:
        sum_tile_of<3>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
      default:
        sum_tile_of<4>(tile, pending_, basis, lights_.data(), stride, sums_.data());
        break;
    }
  }
  summed_ += pending_;
  pending_ = 0;
  if (summed_ >= blocks_per_flush) flush();
}

}  // namespace ssphh::sh
