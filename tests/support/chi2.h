#pragma once
/// Pearson's χ² test of a sampler of directions against its density: does `draw` return directions as often
/// as `pdf` says? What is drawn nowhere (an empty result) or outside the tested cone is one more cell, so a
/// density that does not integrate to the chance of a result fails as well. Fixed seeds: see z_test.h about
/// significance.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include <boost/math/distributions/chi_squared.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/math.h>
#include <ssphh/core/random.h>

#include "z_test.h"

namespace ssphh::test {

struct Chi2Result {
  double statistic = 0;
  int degrees = 0;
  double p = 1;
};

/// Cells that expect fewer than `least_expected` are merged, smallest first, until the sum suffices.
inline Chi2Result chi2_of_counts(const std::vector<double>& observed, const std::vector<double>& expected,
                                 double least_expected = 5) {
  struct Cell {
    double expected, observed;
  };
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < observed.size(); ++i) cells.push_back({expected[i], observed[i]});
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected < b.expected; });

  Chi2Result result;
  int used = 0;
  Cell pooled{0, 0};
  const auto count_pooled = [&] {
    const double d = pooled.observed - pooled.expected;
    result.statistic += d * d / pooled.expected;
    ++used;
    pooled = {0, 0};
  };
  for (const Cell& cell : cells) {
    pooled.expected += cell.expected, pooled.observed += cell.observed;
    if (pooled.expected >= least_expected) count_pooled();
  }
  if (pooled.expected > 0) count_pooled();
  result.degrees = used - 1;
  if (!std::isfinite(result.statistic)) {
    result.p = 0;
  } else if (result.degrees > 0) {
    result.p =
        boost::math::cdf(boost::math::complement(boost::math::chi_squared(result.degrees), result.statistic));
  }
  return result;
}

/// Cells of equal solid angle on the cone around an axis with cos θ ≥ cos_min; −1: the whole sphere.
struct DirectionCells {
  vec3 axis{0, 0, 1};
  double cos_min = -1;
  int polar = 16, azimuth = 24;
  int quadrature = 10;  ///< midpoints per cell and dimension over which the density is integrated
  int draws = 40000;
};

/// `draw(Pcg32&)` returns std::optional<vec3>, `pdf(vec3)` a solid-angle density.
template <class Draw, class Pdf>
::testing::AssertionResult directions_follow(const Draw& draw, const Pdf& pdf, const DirectionCells& cells,
                                             std::uint64_t seed, Significance significance) {
  const Frame frame = Frame::around(cells.axis);
  const std::size_t count = static_cast<std::size_t>(cells.polar) * static_cast<std::size_t>(cells.azimuth);
  const double height = 1 - cells.cos_min;

  // Expected: the density's integral over each cell; the rest of the probability in the last one
  std::vector<double> expected(count + 1), observed(count + 1);
  double inside = 0;
  const int q = cells.quadrature;
  const double sample_solid_angle = 2 * pi_d * height / (static_cast<double>(count) * q * q);
  for (int i = 0; i < cells.polar * q; ++i) {
    const double z = 1 - height * (i + 0.5) / (cells.polar * q);
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    for (int j = 0; j < cells.azimuth * q; ++j) {
      const double phi = 2 * pi_d * (j + 0.5) / (cells.azimuth * q);
      const vec3 local(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                       static_cast<float>(z));
      const double mass = static_cast<double>(pdf(frame.to_world(local))) * sample_solid_angle;
      expected[(i / q) * cells.azimuth + j / q] += mass * cells.draws;
      inside += mass;
    }
  }
  // Midpoint integration of smooth densities is better than this; a larger excess is a wrong density
  if (!(inside <= 1.01)) return ::testing::AssertionFailure() << "the density integrates to " << inside;
  expected[count] = std::max(0.0, 1 - inside) * cells.draws;

  // Observed
  Pcg32 random(seed);
  for (int n = 0; n < cells.draws; ++n) {
    const std::optional<vec3> world = draw(random);
    std::size_t cell = count;
    if (world) {
      const vec3 d = frame.to_local(*world);
      const double down = (1 - static_cast<double>(d.z)) / height;
      const double turn = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / (2 * pi_d);
      if (down <= 1) {
        const int i = std::min(static_cast<int>(std::max(down, 0.0) * cells.polar), cells.polar - 1);
        const int j =
            std::min(static_cast<int>((turn < 0 ? turn + 1 : turn) * cells.azimuth), cells.azimuth - 1);
        cell = static_cast<std::size_t>(i * cells.azimuth + j);
      }
    }
    observed[cell] += 1;
  }

  const Chi2Result result = chi2_of_counts(observed, expected);
  auto outcome =
      result.p >= significance.single() ? ::testing::AssertionSuccess() : ::testing::AssertionFailure();
  return outcome << "χ² " << result.statistic << " with " << result.degrees << " degrees of freedom, p "
                 << result.p << ", allowed " << significance.single() << ", density integrates to " << inside;
}

}  // namespace ssphh::test
