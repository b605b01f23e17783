#pragma once
/// Which probes stand around a point: a grid of cells with a short list each, so that a pixel's work does not
/// depend on how many probes there are.

#include <span>
#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::realtime {

struct ProbeGrid {
  static constexpr int list_length = 16;

  glm::ivec3 cells{1};
  vec3 origin{0};
  float cell_size = 1;
  /// list_length probes for each cell, x fastest, those nearest to its middle first; −1: no more.
  std::vector<int> lists;
};

/// Cells of half the probes' spacing or larger, at most `most_cells`, over `bounds`.
ProbeGrid make_probe_grid(std::span<const vec3> probes, const scene::Bounds& bounds, float spacing,
                          std::size_t most_cells = 1 << 18);

}  // namespace ssphh::realtime
