#pragma once
/// Which probes stand around a point: a grid of cells with a short list each, so that a pixel's work does not
/// depend on how many probes there are.

#include <span>
#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::probes {

struct CandidateGrid {
  /// A point chooses among so many nearest probes, as gi's lookups do.
  static constexpr int wanted = 16;
  static constexpr int longest = 32;

  glm::ivec3 cells{1};
  vec3 origin{0};
  float cell_size = 1;
  int length = 1;  ///< of each list
  /// `length` probes for each cell, x fastest, nearest to its middle first; −1: no more. Holds the `wanted`
  /// nearest of every point of the cell; where those are more than `longest` probes, the nearest to the
  /// middle.
  std::vector<int> lists;
};

/// How far from each probe the points may be that choose among it [m]: the farthest corner of a cell that
/// lists it. Throws Error for a grid of other probes.
std::vector<float> probe_reach(const CandidateGrid& grid, std::span<const vec3> probes);

/// Cells of a third of the probes' spacing or larger, at most `most_cells`, over `bounds`; of a spacing
/// that is no number over 0 one cell.
CandidateGrid make_candidate_grid(std::span<const vec3> probes, const scene::Bounds& bounds, float spacing,
                                  std::size_t most_cells = 1 << 17);

}  // namespace ssphh::probes
