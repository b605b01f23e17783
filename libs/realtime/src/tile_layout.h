#pragma once
/// Where tiles of one size stand in a texture array. Columns are a power of two, so that shaders find a tile
/// by shifts: software renderers divide integers lane by lane.

#include <algorithm>
#include <bit>

namespace ssphh::realtime {

struct TileLayout {
  int columns_log2 = 0, rows = 1, layers = 1;

  TileLayout() = default;
  /// For `tiles` tiles, at most `most` along a side of a layer. A layer need not be larger than what it
  /// holds.
  TileLayout(int tiles, int most) {
    const auto floor_log2 = [](int n) { return std::bit_width(static_cast<unsigned>(std::max(n, 1))) - 1; };
    const int limit = floor_log2(most);
    while (columns_log2 < limit && per_layer() < tiles) ++columns_log2;
    rows = std::clamp((tiles + columns() - 1) / columns(), 1, columns());
    layers = std::max(1, (tiles + per_layer() - 1) / per_layer());
  }

  int columns() const { return 1 << columns_log2; }
  int per_layer() const { return columns() << columns_log2; }  ///< of a layer that is not the only one
  int column(int tile) const { return tile & (columns() - 1); }
  int row(int tile) const { return tile >> columns_log2 & (columns() - 1); }
  int layer(int tile) const { return tile >> 2 * columns_log2; }
};

}  // namespace ssphh::realtime
