#include "surface_grids.h"

#include <algorithm>
#include <numeric>

#include <ssphh/probes/lookup_constants.h>

namespace ssphh::probes {
namespace {

/// Side of a cell, in spacings of points.
constexpr float cell_share = 2.0f / 3;

float median_spacing(std::span<const float> spacings, std::span<const std::uint32_t> points) {
  std::vector<float> sorted;
  for (const std::uint32_t p : points) sorted.push_back(spacings[p]);
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

/// What holds nearly all points that are not much farther apart than the median, and what they reach.
scene::Bounds where_dense(std::span<const rays::SurfacePoint> points, std::span<const float> spacings,
                          const scene::Bounds& all, float spacing) {
  constexpr std::size_t left_out = 200;  // one of so many at each end of each axis
  std::vector<vec3> places;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (spacings[p] <= 2 * spacing) places.push_back(points[p].position);
  }
  scene::Bounds dense = all;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    std::ranges::sort(places, {}, [&](const vec3& place) { return place[axis]; });
    const std::size_t few = places.size() / left_out;
    const float margin = fitted_reach * spacing;
    dense.min[axis] = std::clamp(places[few][axis] - margin, all.min[axis], all.max[axis]);
    dense.max[axis] =
        std::clamp(places[places.size() - 1 - few][axis] + margin, dense.min[axis], all.max[axis]);
  }
  return dense;
}

SurfaceGrid grid_over(const scene::Bounds& bounds, float spacing) {
  constexpr float most_cells = 1 << 21;
  SurfaceGrid grid;
  grid.cell_size = cell_share * spacing;
  // Surfaces of a wall in a cell's plane must not fall into either of two
  const vec3 extent = bounds.max - bounds.min + 0.5f * spacing;
  grid.origin = bounds.min - 0.25f * spacing;
  const auto number = [&] { return glm::ceil(extent / grid.cell_size); };
  while (number().x * number().y * number().z > most_cells) grid.cell_size *= 1.26f;
  grid.cells = ivec3(number());
  return grid;
}

}  // namespace

std::array<SurfaceGrid, 2> surface_grids(std::span<const StillTriangle> triangles,
                                         std::span<const rays::SurfacePoint> points,
                                         std::span<const float> spacings) {
  scene::Bounds all;
  for (const StillTriangle& t : triangles) all.add(t.a), all.add(t.b), all.add(t.c);
  std::vector<std::uint32_t> others(points.size());
  std::iota(others.begin(), others.end(), 0);
  const float spacing = median_spacing(spacings, others);
  const SurfaceGrid one = grid_over(all, spacing);
  if (one.cell_size <= cell_share * spacing) return {one, SurfaceGrid{}};

  const scene::Bounds dense = where_dense(points, spacings, all, spacing);
  std::erase_if(others, [&](std::uint32_t p) {
    const vec3& place = points[p].position;
    return place == glm::clamp(place, dense.min, dense.max);
  });
  constexpr float far = 8;  // where there are no points: what reaches out of the first is all
  const float around = others.empty() ? far * spacing : std::max(spacing, median_spacing(spacings, others));
  return {grid_over(dense, spacing), grid_over(all, around)};
}

}  // namespace ssphh::probes
