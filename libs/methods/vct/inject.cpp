#include "inject.h"

#include <algorithm>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>

namespace ssphh::methods::vct {
namespace {

struct Source {
  const Patch* patch;
  vec3 radiance;
};

/// `sources` of one voxel; sorted anew for each axis.
vec4 side_of(std::vector<Source>& sources, int side) {
  const int axis = side / 2;
  const float toward = side % 2 == 0 ? 1.0f : -1.0f;
  std::ranges::stable_sort(sources, {},
                           [&](const Source& source) { return -toward * source.patch->position[axis]; });
  vec4 seen(0);
  for (const Source& source : sources) {
    const float own = source.patch->cover[side];
    cover(seen, {own * source.radiance, own});
  }
  return seen;
}

}  // namespace

std::vector<VoxelPatches> by_voxel(std::span<const Patch> still, std::span<const Patch> moving) {
  std::vector<VoxelPatches> voxels;
  std::uint32_t s = 0, m = 0;
  while (s < still.size() || m < moving.size()) {
    constexpr VoxelKey none = ~VoxelKey{0};
    const VoxelKey key =
        std::min(s < still.size() ? still[s].voxel : none, m < moving.size() ? moving[m].voxel : none);
    VoxelPatches& voxel = voxels.emplace_back();
    voxel.voxel = key, voxel.still_begin = s, voxel.moving_begin = m;
    while (s < still.size() && still[s].voxel == key) ++s;
    while (m < moving.size() && moving[m].voxel == key) ++m;
    voxel.still_end = s, voxel.moving_end = m;
  }
  return voxels;
}

void inject(std::span<const VoxelPatches> voxels, const LitPatches& still, const LitPatches& moving,
            Pyramid& pyramid) {
  parallel_for(voxels.size(), 512, [&](std::size_t begin, std::size_t end) {
    std::vector<Source> sources;
    const auto add = [&](const LitPatches& lit, std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t i = first; i < last; ++i)
        sources.push_back({&lit.patches[i], lit.patches[i].albedo * lit.irradiance[i] / pi});
    };
    for (std::size_t v = begin; v < end; ++v) {
      const VoxelPatches& voxel = voxels[v];
      sources.clear();
      add(still, voxel.still_begin, voxel.still_end);
      add(moving, voxel.moving_begin, voxel.moving_end);
      Voxel* out = pyramid.find(0, voxel_cell(voxel.voxel));
      SSPHH_CHECK(out);
      for (int side = 0; side < side_count; ++side) out->side[side] = side_of(sources, side);
    }
  });
}

}  // namespace ssphh::methods::vct
