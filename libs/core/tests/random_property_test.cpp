#include <set>

#include "property.h"

namespace ssphh::test {
namespace {

using Word = std::uint32_t;

Generator<Word> words() {
  return integers<Word>(0, ~Word{0});
}

TEST(SobolProperty, ReversingBitsTwiceChangesNothingAndMovesEachBit) {
  EXPECT_TRUE(for_all(words(), integers(0, 31)).cases(300).holds([](Word x, int bit) {
    return reverse_bits(reverse_bits(x)) == x && (reverse_bits(x) >> (31 - bit) & 1) == (x >> bit & 1);
  }));
}

TEST(SobolProperty, ScramblingKeepsWhatTwoNumbersHaveInCommon) {
  // Owen's condition: equal above the first bit that differs, which differs afterwards, too.
  EXPECT_TRUE(for_all(words(), words(), words()).cases(300).holds([](Word x, Word y, Word seed) {
    const auto common = [](Word a, Word b) { return a == b ? 32 : std::countl_zero(a ^ b); };
    return common(owen_scramble(x, seed), owen_scramble(y, seed)) == common(x, y);
  }));
}

TEST(SobolProperty, TheSecondDimensionIsLinearInTheIndex) {
  EXPECT_TRUE(for_all(words(), words()).cases(300).holds([](Word a, Word b) {
    return sobol1_reversed(a ^ b) == (sobol1_reversed(a) ^ sobol1_reversed(b));
  }));
}

/// Whether 2^bits points lie one in each elementary interval of that area, whatever its shape.
template <class Point>
bool is_net(int bits, const Point& point) {
  for (int split = 0; split <= bits; ++split) {
    const int columns = 1 << split, rows = 1 << (bits - split);
    std::set<int> cells;
    for (Word i = 0; i < Word{1} << bits; ++i) {
      const vec2 u = point(i);
      if (!(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1)) return false;
      cells.insert(static_cast<int>(u.x * static_cast<float>(columns)) * rows +
                   static_cast<int>(u.y * static_cast<float>(rows)));
    }
    if (cells.size() != std::size_t{1} << bits) return false;
  }
  return true;
}

TEST(SampleSequenceProperty, EveryBlockOfEverySequenceIsStratified) {
  EXPECT_TRUE(for_all(seeds(), integers(0, 6), integers(0, 1000), integers(0, 5))
                  .cases(60)
                  .holds([](std::uint64_t seed, int bits, int block, int skipped) {
                    return is_net(bits, [&](Word i) {
                      SampleSequence sequence(seed, (static_cast<Word>(block) << bits) + i);
                      for (int n = 0; n < skipped; ++n) n % 2 ? sequence.next2().x : sequence.next();
                      return sequence.next2();
                    });
                  }));
}

TEST(SamplePairsProperty, EveryBlockOfEveryPairIsStratified) {
  EXPECT_TRUE(for_all(seeds(), integers(0, 6), integers(0, 1000), integers(0, 3))
                  .cases(60)
                  .holds([](std::uint64_t seed, int bits, int block, int pair) {
                    return is_net(bits, [&](Word i) {
                      return sample_pairs(seed, (static_cast<Word>(block) << bits) + i)[pair];
                    });
                  }));
}

TEST(PixelSeedProperty, EveryArgumentCounts) {
  EXPECT_TRUE(for_all(seeds(), words(), words(), integers<Word>(0, 5), integers(0, 3), words())
                  .cases(300)
                  .holds([](std::uint64_t seed, Word x, Word y, Word face, int which, Word other) {
                    const std::uint64_t before = pixel_seed(seed, x, y, face);
                    const Word change = other | 1;  // not 0
                    switch (which) {
                      case 0:
                        return pixel_seed(seed + change, x, y, face) != before;
                      case 1:
                        return pixel_seed(seed, x ^ change, y, face) != before;
                      case 2:
                        return pixel_seed(seed, x, y ^ change, face) != before;
                      default:
                        return pixel_seed(seed, x, y, face ^ change) != before;
                    }
                  }));
}

}  // namespace
}  // namespace ssphh::test
