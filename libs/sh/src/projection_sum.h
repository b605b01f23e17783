#pragma once
/// The inner loop of every projection: sums[k][c] += Σ_blocks basis[k] · light[class(k)][c], eight directions
/// per block, as a small matrix product whose accumulators stay in registers.

#include <array>
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

class ProjectionSum {
 public:
  /// `light_class[k]` < light_count says which light coefficient k reads.
  ProjectionSum(int degree, int light_count, const std::array<int, max_coefficient_count>& light_class);

  /// Slot for the next block. The caller fills basis (by direction) and light, weights included.
  void add_direction_block(const float8& x, const float8& y, const float8& z) {
    eval_recurrence(table_, degree_, x, y, z, basis_[pending_].data());
  }
  /// [light_count][3] of the block whose directions were just given.
  float8* light() { return lights_.data() + pending_ * light_count_ * 3; }
  void finish_block() {
    if (++pending_ == blocks_per_pass) sum_pending();
  }

  RadianceSh result();

 private:
  void sum_pending();
  void flush();

  int degree_, light_count_, pending_ = 0, summed_ = 0;
  const RecurrenceTable<float>& table_ = recurrence_table_float();
  std::vector<CoefficientTile> tiles_;
  std::array<std::array<float8, max_coefficient_count>, blocks_per_pass> basis_;
  std::vector<float8> lights_;
  std::array<std::array<float8, 3>, max_coefficient_count> sums_;
  std::array<glm::dvec3, max_coefficient_count> totals_{};
};

}  // namespace ssphh::sh
