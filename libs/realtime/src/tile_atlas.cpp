#include "tile_atlas.h"

namespace ssphh::realtime {
namespace {

constexpr int atlas_side = 2048;

}  // namespace

TileAtlas::TileAtlas(int size, int tiles) : size_(size), layout_(tiles, atlas_side / (size + 2)) {
  const int side = size + 2;
  texture_ = gl::Texture(gl::Format::rgba16f, side * layout_.columns(), side * layout_.rows, layout_.layers);
  texture_.set_filter(true);
}

void TileAtlas::upload(int tile, std::span<const vec4> texels) {
  const int side = size_ + 2;
  texture_.upload_rect(std::as_bytes(texels), layout_.column(tile) * side, layout_.row(tile) * side, side,
                       side, layout_.layer(tile));
}

}  // namespace ssphh::realtime
