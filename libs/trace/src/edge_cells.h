#pragma once
/// Where in a square of cells more should be looked at: noise comes from those that the edge of what hides
/// the light divides. No cell has a say in its own number of looks, or what it saw by chance would be weighed
/// by chance, and a small window's light would be lost.

#include <algorithm>
#include <cstdint>
#include <vector>

namespace ssphh::trace {

class EdgeCells {
 public:
  /// Of side² cells, row by row.
  explicit EdgeCells(int side) : side_(side), cells_(static_cast<std::size_t>(side) * side) {}

  int count() const { return static_cast<int>(cells_.size()); }
  /// One more look into a cell.
  void add(int cell, bool sees) {
    Cell& c = cells_[cell];
    if (c.looks == 0) c.first = sees;
    ++c.looks, c.seen += sees;
  }
  std::uint32_t looks(int cell) const { return cells_[cell].looks; }

  /// Whether those around a cell saw unlike each other at their first look.
  bool at_edge(int cell) const { return at_edge(cell, cell); }
  /// Whether one around it is divided by what was seen at several looks, which it would have got without this
  /// cell, too.
  bool beside_divided(int cell) const {
    return any_around(cell, [&](int n) {
      const Cell& c = cells_[n];
      return c.seen > 0 && c.seen < c.looks && at_edge(n, cell);
    });
  }

 private:
  struct Cell {
    std::uint32_t looks = 0, seen = 0;
    bool first = false;
  };

  bool at_edge(int cell, int without) const {
    const auto sees = [&](bool what) {
      return any_around(cell, [&](int n) { return n != without && cells_[n].first == what; });
    };
    return sees(false) && sees(true);
  }
  template <class Is>
  bool any_around(int cell, const Is& is) const {
    for (int y = std::max(cell / side_ - 1, 0); y <= std::min(cell / side_ + 1, side_ - 1); ++y)
      for (int x = std::max(cell % side_ - 1, 0); x <= std::min(cell % side_ + 1, side_ - 1); ++x)
        if (const int other = y * side_ + x; other != cell && is(other)) return true;
    return false;
  }

  int side_;
  std::vector<Cell> cells_;
};

}  // namespace ssphh::trace
