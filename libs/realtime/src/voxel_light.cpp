#include "voxel_light.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <ssphh/core/error.h>
#include <ssphh/methods/vct/pyramid.h>

namespace ssphh::realtime {
namespace {

using methods::vct::BrickView;
using methods::vct::Cell;
using methods::vct::Pyramid;
using methods::vct::side_count;
using methods::vct::Voxel;
constexpr int brick = methods::vct::VoxelGrid::brick;

/// Halves hold relative precision from 6e-5 to 65504: the brightest voxel stands well within.
constexpr float brightest_in_volume = 1024;

/// Visits the voxels of a brick: visit(x, y, z, voxel).
template <class Visit>
void for_each_voxel(const BrickView& view, const Visit& visit) {
  for (int z = 0; z < brick; ++z)
    for (int y = 0; y < brick; ++y)
      for (int x = 0; x < brick; ++x) visit(x, y, z, view.first[z * view.layer + y * view.row + x]);
}

float brightest(const Pyramid& voxels) {
  float most = 0;
  for (int level = 0; level < voxels.levels(); ++level) {
    const Cell size = voxels.grid().level_size(level);
    for (int z = 0; z < size.z / brick; ++z)
      for (int y = 0; y < size.y / brick; ++y)
        for (int x = 0; x < size.x / brick; ++x) {
          const BrickView view = voxels.view(level, {x, y, z});
          if (!view.first) continue;
          for_each_voxel(view, [&](int, int, int, const Voxel& voxel) {
            for (const vec4& side : voxel.side) most = std::max(most, max_component(vec3(side)));
          });
        }
  }
  return most;
}

GpuConeBlock cone_block(const methods::VoxelCones& data, const VolumeLayout& layout, float unit_radiance) {
  const methods::vct::VoxelGrid& grid = data.voxels->grid();
  GpuConeBlock block;
  block.grid = vec4(grid.origin, grid.voxel);
  block.march = vec4(data.cones.offset, data.cones.opacity, data.cones.step, unit_radiance);
  block.counts = ivec4(data.cones.cones, grid.levels() - 1, 0, 0);
  block.part = vec4(vec3(layout.part), 0);
  block.texel = vec4(1.0f / vec3(layout.size()), 0);
  for (std::size_t level = 0; level < layout.cells.size(); ++level) {
    block.cells[level] = vec4(vec3(layout.cells[level]), 0);
    block.first[level] = vec4(vec3(layout.first[level]), 0);
  }
  for (int i = 0; i <= lobe_steps; ++i)
    block.lobe_cosines[i / 4][i % 4] =
        methods::vct::lobe_cosine(static_cast<float>(i) / static_cast<float>(lobe_steps));
  return block;
}

void check_bytes(std::size_t bytes, std::size_t most) {
  if (bytes <= most) return;
  throw Error("method vct",
              fmt::format("its voxels would take {:.2f} GB in OpenGL, {:.2f} GB is the most",
                          static_cast<double>(bytes) / 1e9, static_cast<double>(most) / 1e9),
              "take a lower resolution, or --backend cpu, which keeps them in an octree");
}

}  // namespace

VoxelLight::VoxelLight(const methods::VoxelCones& data, std::size_t most_bytes, FrameCounters& counters)
    : layout_(data.voxels->grid()) {
  check_bytes(layout_.bytes(), most_bytes);
  volume_ = gl::Volume(layout_.size());
  block_ = gl::Buffer(sizeof(GpuConeBlock));
  upload_all(data, counters);
}

bool VoxelLight::take(const methods::LightData& data, FrameCounters& counters) {
  const auto* cones = std::get_if<methods::VoxelCones>(&data);
  if (!cones || VolumeLayout(cones->voxels->grid()).cells != layout_.cells) return false;
  volume_.clear();
  upload_all(*cones, counters);
  return true;
}

void VoxelLight::upload_all(const methods::VoxelCones& data, FrameCounters& counters) {
  const float most = brightest(*data.voxels);
  const float scale = most > 0 ? brightest_in_volume / most : 1;
  for (int level = 0; level < data.voxels->levels(); ++level)
    upload_level(*data.voxels, level, scale, counters);

  std::vector<GpuCone> cones;
  for (const methods::vct::Cone& cone : methods::vct::hemisphere_cones(data.cones.cones))
    cones.emplace_back(cone.direction, cone.tangent);
  cones_.reserve(cones.size() * sizeof(GpuCone));
  upload(counters, cones_, std::span<const GpuCone>(cones));
  cone_count_ = data.cones.cones;
  const GpuConeBlock block = cone_block(data, layout_, 1 / scale);
  upload(counters, block_, std::span<const GpuConeBlock>(&block, 1));
}

void VoxelLight::upload_level(const Pyramid& voxels, int level, float scale, FrameCounters& counters) {
  const ivec3 cells = layout_.cells[level];
  const ivec3 first = layout_.first[level];
  const auto row = static_cast<std::size_t>(cells.x), layer = row * static_cast<std::size_t>(cells.y);
  const std::size_t side_texels = layer * brick;
  for (int z = 0; z < cells.z / brick; ++z) {
    slab_.assign(side_texels * side_count, 0);
    bool any = false;
    for (int y = 0; y < cells.y / brick; ++y) {
      for (int x = 0; x < cells.x / brick; ++x) {
        const BrickView view = voxels.view(level, {x, y, z});
        if (!view.first) continue;
        any = true;
        for_each_voxel(view, [&](int i, int j, int k, const Voxel& voxel) {
          const std::size_t at = static_cast<std::size_t>(k) * layer +
                                 static_cast<std::size_t>(brick * y + j) * row +
                                 static_cast<std::size_t>(brick * x + i);
          for (std::size_t side = 0; side < side_count; ++side) {
            const vec4& shown = voxel.side[side];
            if (shown.w > 0)
              slab_[side * side_texels + at] = glm::packHalf4x16(vec4(scale * vec3(shown), shown.w));
          }
        });
      }
    }
    if (!any) continue;
    const std::span<const std::uint64_t> texels(slab_);
    for (int side = 0; side < side_count; ++side)
      volume_.upload_box(texels.subspan(static_cast<std::size_t>(side) * side_texels, side_texels),
                         layout_.corner(side) + first + ivec3(0, 0, brick * z), {cells.x, cells.y, brick});
    counters.bytes_uploaded += texels.size_bytes();
  }
}

void VoxelLight::bind(gl::Program& /*program*/, int /*pass*/) const {
  volume_.bind(unit::voxels);
  block_.bind_uniform(binding::cone_block);
  cones_.bind_storage(binding::cones);
}

std::size_t VoxelLight::bytes() const {
  return volume_.bytes() + block_.size() + cones_.size();
}

methods::MethodNumbers VoxelLight::numbers() const {
  return {{"gl_bytes", static_cast<double>(bytes())}, {"gl_cones", cone_count_}};
}

}  // namespace ssphh::realtime
