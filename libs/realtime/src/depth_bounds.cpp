#include "depth_bounds.h"

#include <algorithm>
#include <bit>

#include <ssphh/gl/draw.h>

namespace ssphh::realtime {
namespace {

constexpr int depth_atlas_side = 4096;

}  // namespace

DepthBounds::DepthBounds(int size, int tiles)
    : tiles_(tiles),
      levels_(static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(size, 2)) - 1))),
      layout_(tiles, depth_atlas_side >> levels_) {
  const int side = 1 << (levels_ - 1);
  texture_ =
      gl::Texture(gl::Format::rg32f, side * layout_.columns(), side * layout_.rows, layout_.layers, true);
  for (int layer = 0; layer < layout_.layers; ++layer) {
    for (int level = 0; level < levels_; ++level) targets_.emplace_back(texture_, layer, level);
  }
}

void DepthBounds::update(const MapAtlas& maps, Shaders& shaders, const gl::VertexArray& no_vertices,
                         FrameCounters& counters) {
  if (maps.changed().empty()) return;
  maps.texture().bind(unit::parallel_maps);
  bind();
  no_vertices.bind();
  gl::apply({});
  for (const int tile : maps.changed()) {
    if (tile < tiles_) update_tile(tile, maps, shaders, counters);
  }
}

void DepthBounds::update_tile(int tile, const MapAtlas& maps, Shaders& shaders, FrameCounters& counters) {
  const TileLayout& from = maps.layout();
  for (int level = 0; level < levels_; ++level) {
    gl::texture_barrier();
    const int side = 1 << (levels_ - 1 - level);
    const gl::Rect rect{layout_.column(tile) * side, layout_.row(tile) * side, side, side};
    gl::bind_framebuffer(targets_[layout_.layer(tile) * levels_ + level].id(), rect);
    gl::Program& program = shaders.depth_bounds(level == 0);
    program.set("target", rect.x, rect.y);
    if (level == 0) {
      program.set("source", from.column(tile) * maps.size(), from.row(tile) * maps.size(), from.layer(tile),
                  0);
      program.set("last", maps.size() - 1);
    } else {
      program.set("source", 2 * rect.x, 2 * rect.y, layout_.layer(tile), level - 1);
      program.set("last", 2 * side - 1);
    }
    program.use();
    gl::draw_triangles(3);
    ++counters.draw_calls;
  }
  gl::texture_barrier();
}

void DepthBounds::bind() const {
  texture_.bind(unit::depth_bounds);
}

std::size_t DepthBounds::bytes() const {
  return texture_.bytes() * 4 / 3;
}

}  // namespace ssphh::realtime
