#pragma once
/// How fast an iteration with a matrix without negative entries converges.

#include <cstddef>
#include <functional>
#include <span>

namespace ssphh {

/// Bounds of the spectral radius of a matrix without negative entries: the factor by which one more
/// application shrinks light.
struct Contraction {
  double lower = 0, upper = 0;
};

/// Writes A x to y; both have as many entries as A has rows.
using ApplyMatrix = std::function<void(std::span<const double> x, std::span<double> y)>;

/// From `steps` power iterations of a matrix with `rows` rows (Collatz & Wielandt: for a matrix without
/// negative entries and a positive vector x, the radius lies between the extreme ratios (Ax)_i / x_i). Zero
/// for no rows.
Contraction contraction(std::size_t rows, const ApplyMatrix& apply, int steps = 16);

}  // namespace ssphh
