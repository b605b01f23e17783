/// Which cells of a square are looked at again.

#include "edge_cells.h"

#include <gtest/gtest.h>

#include <ssphh/core/random.h>

namespace ssphh::trace {
namespace {

constexpr int side = 6;

/// Looked at once each, by bits of a number; then again where it is said.
EdgeCells looked_at(std::uint64_t first) {
  EdgeCells cells(side);
  for (int cell = 0; cell < cells.count(); ++cell) cells.add(cell, (first >> cell & 1) != 0);
  for (int cell = 0; cell < cells.count(); ++cell) {
    if (cells.at_edge(cell)) cells.add(cell, cell % 3 == 0);
  }
  return cells;
}

TEST(EdgeCells, AreThoseAroundAWindowAndWhatLiesBesideThem) {
  EdgeCells cells(side);
  const auto in_window = [](int cell) { return cell % side >= 3; };
  for (int cell = 0; cell < cells.count(); ++cell) cells.add(cell, in_window(cell));
  for (int cell = 0; cell < cells.count(); ++cell) {
    const int x = cell % side;
    EXPECT_EQ(cells.at_edge(cell), x == 2 || x == 3) << cell;
    EXPECT_FALSE(cells.beside_divided(cell)) << "nobody looked twice";
  }
  for (int y = 0; y < side; ++y) cells.add(y * side + 2, true);
  for (int cell = 0; cell < cells.count(); ++cell) {
    const int x = cell % side;
    if (x != 2) {
      EXPECT_EQ(cells.beside_divided(cell), x == 1 || x == 3) << cell;
    }
  }
}

TEST(EdgeCells, NoneHasASayInItsOwnNumberOfLooks) {
  Pcg32 random(5);
  int again = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::uint64_t first = std::uint64_t{random.next()} << 32 | random.next();
    const std::uint64_t few = first & (std::uint64_t{random.next()} << 32 | random.next()) &
                              (std::uint64_t{random.next()} << 32 | random.next());
    const int cell = trial % (side * side);
    const EdgeCells cells = looked_at(few), other = looked_at(few ^ std::uint64_t{1} << cell);
    ASSERT_EQ(cells.at_edge(cell), other.at_edge(cell)) << few << " " << cell;
    ASSERT_EQ(cells.beside_divided(cell), other.beside_divided(cell)) << few << " " << cell;
    again += cells.beside_divided(cell);
  }
  EXPECT_GT(again, 100);
}

}  // namespace
}  // namespace ssphh::trace
