/// Bounds of spectral radii, against matrices whose radius is known.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/contraction.h>

namespace ssphh {
namespace {

TEST(Contraction, EnclosesTheRadiusOfAMatrixWithoutNegativeEntries) {
  // [[1, 2], [3, 4]] / 10: (5 + √33) / 20.
  const ApplyMatrix apply = [](std::span<const double> x, std::span<double> y) {
    y[0] = 0.1 * x[0] + 0.2 * x[1];
    y[1] = 0.3 * x[0] + 0.4 * x[1];
  };
  const double radius = (5 + std::sqrt(33.0)) / 20;
  double width = 1;
  for (const int steps : {1, 2, 4, 8}) {
    const Contraction found = contraction(2, apply, steps);
    EXPECT_LE(found.lower, radius + 1e-15);
    EXPECT_GE(found.upper, radius - 1e-15);
    EXPECT_LT(found.upper - found.lower, width);
    width = found.upper - found.lower;
  }
  EXPECT_LT(width, 1e-7) << "the other eigenvalue is 14 times smaller";
}

TEST(Contraction, OfRowsThatNothingReachesIsNoLowerThanThatOfTheRest) {
  // Row 1 is empty; row 0 keeps a half of itself.
  const Contraction found = contraction(2, [](std::span<const double> x, std::span<double> y) {
    y[0] = 0.5 * x[0];
    y[1] = 0;
  });
  EXPECT_EQ(found.upper, 0.5);
  EXPECT_EQ(found.lower, 0);
}

TEST(Contraction, OfNothingIsZero) {
  const ApplyMatrix dark = [](std::span<const double>, std::span<double> y) { std::ranges::fill(y, 0.0); };
  for (const std::size_t rows : {0, 3}) {
    EXPECT_EQ(contraction(rows, dark).lower, 0);
    EXPECT_EQ(contraction(rows, dark).upper, 0);
  }
  EXPECT_EQ(Contraction().lower, 0);
  EXPECT_EQ(Contraction().upper, 0);
}

}  // namespace
}  // namespace ssphh
