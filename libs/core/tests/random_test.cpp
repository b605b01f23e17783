#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>

namespace ssphh {
namespace {

TEST(SampleSequence, EveryPairOfDimensionsIsAZeroTwoNet) {
  // Every elementary interval of area 1/256 holds exactly one of 256 points.
  constexpr int log_n = 8, n = 1 << log_n;
  for (int pair = 0; pair < 3; ++pair) {
    for (int split = 0; split <= log_n; ++split) {
      const int columns = 1 << split, rows = n / columns;
      std::set<int> cells;
      for (std::uint32_t i = 0; i < n; ++i) {
        SampleSequence sequence(42, i);
        vec2 u = sequence.next2();
        for (int skip = 0; skip < pair; ++skip) u = sequence.next2();
        cells.insert(static_cast<int>(u.x * static_cast<float>(columns)) * rows +
                     static_cast<int>(u.y * static_cast<float>(rows)));
      }
      EXPECT_EQ(cells.size(), static_cast<std::size_t>(n))
          << "pair " << pair << ", " << columns << " columns";
    }
  }
}

TEST(SampleSequence, OneDimensionIsStratified) {
  std::set<int> cells;
  for (std::uint32_t i = 0; i < 64; ++i) cells.insert(static_cast<int>(SampleSequence(7, i).next() * 64));
  EXPECT_EQ(cells.size(), 64u);
}

TEST(SampleSequence, DimensionsAndPixelsAreUncorrelated) {
  // Correlation of n independent uniforms has standard deviation 1/√n; 4.5 σ is 7e-6 two-sided, four tests.
  constexpr int n = 4096;
  double across_dimensions = 0, across_pixels = 0, across_pair = 0, one_against_two = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    SampleSequence a(1, i), b(2, i), c(1, i);
    const vec2 first = a.next2(), second = a.next2(), other = b.next2();
    const float one = c.next();
    across_pair += (first.x - 0.5) * (first.y - 0.5);
    across_dimensions += (first.x - 0.5) * (second.x - 0.5);
    across_pixels += (first.x - 0.5) * (other.x - 0.5);
    one_against_two += (one - 0.5) * (second.y - 0.5);
  }
  const double limit = 4.5 / 12 / std::sqrt(n) * n;
  EXPECT_LT(std::abs(across_pair), limit);
  EXPECT_LT(std::abs(across_dimensions), limit);
  EXPECT_LT(std::abs(across_pixels), limit);
  EXPECT_LT(std::abs(one_against_two), limit);
}

TEST(SamplePairs, EveryPairIsAZeroTwoNet) {
  constexpr int log_n = 8, n = 1 << log_n;
  for (std::size_t pair = 0; pair < 4; ++pair) {
    for (int split = 0; split <= log_n; ++split) {
      const int columns = 1 << split, rows = n / columns;
      std::set<int> cells;
      for (std::uint32_t i = 0; i < n; ++i) {
        const vec2 u = sample_pairs(42, i)[pair];
        cells.insert(static_cast<int>(u.x * static_cast<float>(columns)) * rows +
                     static_cast<int>(u.y * static_cast<float>(rows)));
      }
      EXPECT_EQ(cells.size(), static_cast<std::size_t>(n))
          << "pair " << pair << ", " << columns << " columns";
    }
  }
}

TEST(SamplePairs, LanesAreUncorrelatedAlongASequenceAndAcrossSeeds) {
  // As above: 28 pairs of lanes twice, 4.5 σ each.
  constexpr int n = 4096;
  double along[8][8] = {}, across[8][8] = {};
  const auto add = [](const std::array<vec2, 4>& pairs, double(&sums)[8][8]) {
    const auto lane = [&](std::size_t k) {
      return static_cast<double>(k % 2 ? pairs[k / 2].y : pairs[k / 2].x);
    };
    for (std::size_t a = 0; a < 8; ++a) {
      for (std::size_t b = 0; b < a; ++b) sums[a][b] += (lane(a) - 0.5) * (lane(b) - 0.5);
    }
  };
  for (std::uint32_t i = 0; i < n; ++i) add(sample_pairs(1, i), along), add(sample_pairs(i, 3), across);
  const double limit = 4.5 / 12 / std::sqrt(n) * n;
  for (std::size_t a = 0; a < 8; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_LT(std::abs(along[a][b]), limit) << "lanes " << a << ", " << b;
      EXPECT_LT(std::abs(across[a][b]), limit) << "lanes " << a << ", " << b;
    }
  }
}

TEST(Pcg32, MomentsOfTheUniformDistribution) {
  constexpr int n = 100000;
  Pcg32 rng(5);
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
  }
  EXPECT_NEAR(sum / n, 0.5, 4.5 * std::sqrt(1.0 / 12 / n));  // 4.5 σ: 7e-6
  EXPECT_NEAR(squares / n, 1.0 / 3, 4.5 * std::sqrt(4.0 / 45 / n));
}

TEST(Pcg32, SeedsAndStreamsDiffer) {
  EXPECT_NE(Pcg32(1).next(), Pcg32(2).next());
  EXPECT_NE(Pcg32(1, 0).next(), Pcg32(1, 1).next());
  EXPECT_EQ(Pcg32(3, 4).next(), Pcg32(3, 4).next());
}

// SplitMix64 (Steele et al. 2014) from state 0 and from its second state, as the reference implementation
// prints.
TEST(Mix64, HasThePublishedValues) {
  EXPECT_EQ(mix64(0), 0xe220a8397b1dcdafull);
  EXPECT_EQ(mix64(0x9e3779b97f4a7c15ull), 0x6e789e6aa1b965f4ull);
}

TEST(PixelSeed, IsAnotherForEachPlaceAndEachSeed) {
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t seed : {0, 1}) {
    for (std::uint32_t x = 0; x < 4; ++x)
      for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t face = 0; face < 6; ++face) seeds.insert(pixel_seed(seed, x, y, face));
  }
  EXPECT_EQ(seeds.size(), 2u * 4 * 4 * 6);
  EXPECT_NE(hash_combine(1, 2), hash_combine(2, 1));
}

TEST(ToUnitFloat, NeverReachesOne) {
  EXPECT_LT(to_unit_float(0xffffffffu), 1.0f);
}

}  // namespace
}  // namespace ssphh
