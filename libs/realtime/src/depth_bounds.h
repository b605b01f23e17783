#pragma once
/// Greatest and least depth that a sun's maps hold in squares of 2, 4, 8, … texels: where nothing stands
/// before a surface, or everything, no further texel has to be looked at.

#include <vector>

#include "shaders.h"
#include "shadow_maps.h"

namespace ssphh::realtime {

class DepthBounds {
 public:
  /// For the first `tiles` tiles of maps of `size` texels.
  DepthBounds(int size, int tiles);

  /// Brings those up to date that `maps` changed last. One small draw call for each level.
  void update(const MapAtlas& maps, Shaders& shaders, const gl::VertexArray& no_vertices,
              FrameCounters& counters);
  void bind() const;
  const TileLayout& layout() const { return layout_; }
  /// Squares of 2^levels texels are the largest: one holds the whole tile.
  int levels() const { return levels_; }
  std::size_t bytes() const;

 private:
  void update_tile(int tile, const MapAtlas& maps, Shaders& shaders, FrameCounters& counters);

  int tiles_, levels_;
  TileLayout layout_;
  gl::Texture texture_;  ///< level l - 1 holds squares of 2^l texels: x the greatest, y the least depth
  std::vector<gl::Framebuffer> targets_;  ///< of layer 0, level by level, then of layer 1, …
};

}  // namespace ssphh::realtime
