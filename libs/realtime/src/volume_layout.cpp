#include "volume_layout.h"

#include <algorithm>

#include <ssphh/gl/volume.h>

namespace ssphh::realtime {

VolumeLayout::VolumeLayout(const methods::vct::VoxelGrid& grid) {
  constexpr int border = 1;
  int row = 0, depth = 0;
  for (int level = 0; level < grid.levels(); ++level) {
    const methods::vct::Cell c = grid.level_size(level);
    const ivec3 with_border = ivec3(c.x, c.y, c.z) + 2 * border;
    cells.emplace_back(c.x, c.y, c.z);
    if (level == 0) {
      first.emplace_back(border);
      part = with_border;
    } else {
      first.push_back(ivec3(row, 0, cells[0].z + 2 * border) + border);
      row += with_border.x;
      depth = std::max(depth, with_border.z);
      part = {std::max(part.x, row), std::max(part.y, with_border.y), part.z};
    }
  }
  part.z += depth;
}

std::size_t VolumeLayout::bytes() const {
  const ivec3 s = size();
  return static_cast<std::size_t>(s.x) * static_cast<std::size_t>(s.y) * static_cast<std::size_t>(s.z) *
         gl::Volume::texel_bytes;
}

}  // namespace ssphh::realtime
