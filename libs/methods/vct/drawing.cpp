#include "drawing.h"

namespace ssphh::methods::vct {

sketch::Sketch voxels_drawing(const Pyramid& voxels, std::span<const VoxelKey> keys) {
  constexpr float seam = 0.04f;  // of the edge, on each side
  sketch::Sketch marks;
  for (const VoxelKey key : keys) {
    const Cell cell = voxel_cell(key);
    const Voxel* voxel = voxels.find(0, cell);
    if (voxel == nullptr) continue;
    const vec3 corner(cell.x, cell.y, cell.z);
    sketch::Box box{.min = voxels.grid().to_world(corner + seam),
                    .max = voxels.grid().to_world(corner + 1.0f - seam),
                    .light = true};
    vec4 all(0);
    for (const vec4& side : voxel->side) all += side;
    if (!(all.w > 0)) continue;
    for (std::size_t k = 0; k < box.colors.size(); ++k) {
      const vec4& side = voxel->side[k];
      box.colors[k] = side.w > 0 ? vec3(side) / side.w : vec3(all) / all.w;
    }
    marks.boxes.push_back(box);
  }
  return marks;
}

}  // namespace ssphh::methods::vct
