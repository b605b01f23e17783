#pragma once
/// Where probes stand: the middles of equal cells that fill a box.

#include <ssphh/scene/query.h>

namespace ssphh::methods::ddgi {

struct ProbeGrid {
  vec3 first{0};        ///< probe (0, 0, 0) [m]
  vec3 spacing{1};      ///< between neighbours along each axis [m]
  glm::ivec3 count{1};  ///< probes along each axis

  int size() const { return count.x * count.y * count.z; }
  int index(const glm::ivec3& cell) const { return (cell.z * count.y + cell.y) * count.x + cell.x; }
  glm::ivec3 cell(int index) const {
    return {index % count.x, index / count.x % count.y, index / (count.x * count.y)};
  }
  vec3 position(int index) const { return first + spacing * vec3(cell(index)); }
  float least_spacing() const { return glm::min(spacing.x, glm::min(spacing.y, spacing.z)); }
};

/// Cells over `bounds` whose edges are at most `spacing` metres; if that is 0, some `probes` nearly cubic
/// ones. Throws Error for more than `most` probes.
ProbeGrid make_grid(const scene::Bounds& bounds, float spacing, int probes, int most);

}  // namespace ssphh::methods::ddgi
