#include "point_cells.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/error.h>

namespace ssphh::transport {

PointCell PointGrid::cell(const rays::SurfacePoint& point, int level) const {
  const vec3 at = glm::floor(std::ldexp(1.0f, -level) * (point.position - origin) / size);
  const vec3 n = glm::abs(point.normal);
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : (n.y >= n.z ? 1 : 2);
  return {level, static_cast<long>(at.x), static_cast<long>(at.y), static_cast<long>(at.z),
          2 * axis + (point.normal[axis] < 0)};
}

PointCells PointGrid::sort(std::span<const rays::SurfacePoint> points, std::span<const int> levels) const {
  PointCells cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    cells[cell(points[i], levels.empty() ? 0 : levels[i])].push_back(i);
  return cells;
}

PointGrid finest_grid(std::span<const rays::SurfacePoint> points, std::span<const int> levels, int count) {
  require(std::ranges::all_of(points, is_finite, &rays::SurfacePoint::position), "points to spread",
          "a place is not finite");
  vec3 low = points[0].position, high = low;
  for (const rays::SurfacePoint& p : points) {
    low = glm::min(low, p.position);
    high = glm::max(high, p.position);
  }
  const float extent = std::max(max_component(high - low), 1e-15f);  // its square is above 0
  float small = extent * 1e-6f, large = 2 * extent;  // large: six cubes of a level at most, one for each side
  while (large > 1.01f * small) {
    const float size = std::sqrt(small * large);
    const bool fits = PointGrid{low, size}.sort(points, levels).size() <= static_cast<std::size_t>(count);
    (fits ? large : small) = size;
  }
  return {low, large};
}

std::size_t middle_one(std::span<const rays::SurfacePoint> points, std::span<const std::size_t> members) {
  vec3 mean(0);
  for (const std::size_t i : members) mean += points[i].position / static_cast<float>(members.size());
  return *std::ranges::min_element(members, {}, [&](std::size_t i) {
    const vec3 d = points[i].position - mean;
    return glm::dot(d, d);
  });
}

}  // namespace ssphh::transport
