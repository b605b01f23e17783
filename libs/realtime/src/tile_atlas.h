#pragma once
/// Tiles of one size (tile_basis.h) in a texture array.

#include <algorithm>
#include <span>
#include <vector>

#include <ssphh/core/parallel.h>
#include <ssphh/core/vectors.h>
#include <ssphh/gl/texture.h>

#include "tile_layout.h"

namespace ssphh::realtime {

class TileAtlas {
 public:
  TileAtlas() = default;
  /// `size` texels along a side without the border.
  TileAtlas(int size, int tiles);

  int size() const { return size_; }
  const TileLayout& layout() const { return layout_; }
  std::size_t bytes() const { return texture_.id() ? texture_.bytes() / 2 : 0; }
  void upload(int tile, std::span<const vec4> texels);
  void bind(unsigned unit) const { texture_.bind(unit); }

  /// Uploads `count` tiles: tile(i) says which is the i-th, and make(i, texels), called from several threads,
  /// what it holds. Returns the bytes of what was made; `memory` is scratch.
  template <class Tile, class Make>
  std::size_t fill(std::size_t count, const Tile& tile, const Make& make, std::vector<vec4>& memory) {
    // In portions, so that many tiles need no more memory than a few
    constexpr std::size_t portion = 256;
    const std::size_t each = texels();
    if (memory.size() < std::min(portion, count) * each) memory.resize(std::min(portion, count) * each);
    for (std::size_t first = 0; first < count; first += portion) {
      const std::size_t n = std::min(portion, count - first);
      const auto of = [&](std::size_t i) { return std::span(memory).subspan(i * each, each); };
      parallel_for(n, 4, [&](std::size_t i) { make(first + i, of(i)); });
      for (std::size_t i = 0; i < n; ++i) upload(tile(first + i), of(i));
    }
    return count * each * sizeof(vec4);
  }

 private:
  std::size_t texels() const {
    return static_cast<std::size_t>(size_ + 2) * static_cast<std::size_t>(size_ + 2);
  }

  int size_ = 0;
  TileLayout layout_;
  gl::Texture texture_;
};

}  // namespace ssphh::realtime
