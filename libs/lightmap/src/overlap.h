#pragma once
/// Triangles in a plane, added one after another unless they overlap one that is there.

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::lightmap {

using FlatCorners = std::array<vec2, 3>;

/// Whether two triangles have more in common than borders, rounding aside: no line along an edge has them on
/// either side, but for a hundred-thousandth of their size.
bool overlap(const FlatCorners& a, const FlatCorners& b);

/// Triangles by the cells of grids, each in the grid whose cells are about as large as it.
class FlatTriangles {
 public:
  /// False, and nothing is added, where the triangle overlaps another.
  bool add(const FlatCorners& triangle);

 private:
  struct Cell {
    std::int64_t x, y;
    friend auto operator<=>(const Cell&, const Cell&) = default;
  };
  struct Level {
    float size = 0;
    std::vector<std::uint32_t> all;
    std::map<Cell, std::vector<std::uint32_t>> cells;
  };
  bool overlaps(const FlatCorners& triangle) const;

  std::vector<FlatCorners> triangles_;
  std::map<int, Level> levels_;  ///< by the cells' size, a power of two
};

}  // namespace ssphh::lightmap
