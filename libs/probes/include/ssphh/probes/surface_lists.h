#pragma once
/// Points on surfaces that stand still (fitted weights, surface records) made ready to be looked up without
/// rays: which of them light which part of the surfaces. Made once for a scene and its points; light that
/// changes costs nothing here.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/scene/scene.h>

namespace ssphh::probes {

using glm::ivec3;
using glm::uvec2;
using glm::uvec4;

/// Cells over surfaces, numbered x fastest.
struct SurfaceGrid {
  vec3 origin{0};
  float cell_size = 1;  ///< metres
  ivec3 cells{0};
  std::size_t first = 0;  ///< of SurfaceLists::ranges

  std::size_t count() const {
    return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
           static_cast<std::size_t>(cells.z);
  }
  vec3 end() const { return origin + cell_size * vec3(cells); }
};

/// Grids of cells over the surfaces. A cell that holds surface lists the points that may light it, as
/// SurfaceInterpolation finds them, and for each which of 64 parts of the cell see it: columns along an axis
/// or cubes, as its entry says.
struct SurfaceLists {
  static constexpr int longest =
      96;  ///< points of a list; the nearest to the cell's middle, in their spacings
  static constexpr std::size_t most_points = std::size_t{1} << 19;

  std::vector<rays::SurfacePoint> points;
  /// A place is in the first whose box holds it. Cells are ⅔ of the median spacing, or more where those would
  /// be too many. In a scene so wide, the first holds the places where points are dense, and the second all,
  /// in cells for the other points; else the second has no cells.
  std::array<SurfaceGrid, 2> grids;
  std::vector<uvec2>
      ranges;                ///< of each cell of each grid: first of `lists`, number of points; 0: no surface
  std::vector<uvec4> lists;  ///< of each cell its points, as pack_surface_entry makes them

  bool empty() const { return lists.empty(); }
};

/// Finds the lists for the scene posed at `time`. `sees` tells whether nothing blocks the way between two
/// points just above surfaces: of that pose, or of several at once, where what moves may come between. It is
/// called from several threads. Empty for fewer than two points. Throws Error for more than `most_points`,
/// and Cancelled.
SurfaceLists prepare_surfaces(const scene::Scene& scene, float time, std::vector<rays::SurfacePoint> points,
                              const SeesProbe& sees, const Control& control = {});

}  // namespace ssphh::probes
