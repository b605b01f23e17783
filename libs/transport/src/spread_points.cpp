#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <ssphh/core/error.h>
#include <ssphh/transport/fitted_weights.h>

namespace ssphh::transport {
namespace {

/// A cube of a grid of some level, and the side of it that a normal faces most.
using Cell = std::tuple<int, long, long, long, int>;

Cell cell_of(const rays::SurfacePoint& point, int level, const vec3& origin, float size) {
  const vec3 at = glm::floor(std::ldexp(1.0f, -level) * (point.position - origin) / size);
  const vec3 n = glm::abs(point.normal);
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : (n.y >= n.z ? 1 : 2);
  return {level, static_cast<long>(at.x), static_cast<long>(at.y), static_cast<long>(at.z),
          2 * axis + (point.normal[axis] < 0)};
}

using Cells = std::map<Cell, std::vector<std::size_t>>;

Cells sort_into_cells(std::span<const rays::SurfacePoint> points, std::span<const int> levels,
                      const vec3& origin, float size) {
  Cells cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    cells[cell_of(points[i], levels.empty() ? 0 : levels[i], origin, size)].push_back(i);
  return cells;
}

/// The one nearest to the middle of all.
std::size_t middle_one(std::span<const rays::SurfacePoint> points, std::span<const std::size_t> members) {
  vec3 mean(0);
  for (const std::size_t i : members) mean += points[i].position / static_cast<float>(members.size());
  return *std::ranges::min_element(members, {}, [&](std::size_t i) {
    const vec3 d = points[i].position - mean;
    return glm::dot(d, d);
  });
}

}  // namespace

std::vector<rays::SurfacePoint> spread_points(std::span<const rays::SurfacePoint> points, int count,
                                              std::span<const int> levels) {
  if (count < 1) throw Error("points to spread", "there must be at least one");
  require(levels.empty() || levels.size() == points.size(), "points to spread",
          "not every point has its level");
  if (points.size() <= static_cast<std::size_t>(count)) return {points.begin(), points.end()};
  require(std::ranges::all_of(points, is_finite, &rays::SurfacePoint::position), "points to spread",
          "a place is not finite");
  vec3 low = points[0].position, high = low;
  for (const rays::SurfacePoint& p : points) {
    low = glm::min(low, p.position);
    high = glm::max(high, p.position);
  }

  // The smallest cells, within one per cent, that are no more than asked for
  const float extent = std::max(max_component(high - low), 1e-15f);  // its square is above 0
  float small = extent * 1e-6f, large = 2 * extent;  // large: six cells of a level at most, one for each side
  Cells best = sort_into_cells(points, levels, low, large);
  while (large > 1.01f * small) {
    const float size = std::sqrt(small * large);
    Cells cells = sort_into_cells(points, levels, low, size);
    const bool fits = cells.size() <= static_cast<std::size_t>(count);
    (fits ? large : small) = size;
    if (fits) best = std::move(cells);
  }

  std::vector<std::size_t> chosen;
  for (const auto& [cell, members] : best) chosen.push_back(middle_one(points, members));
  std::ranges::sort(chosen);
  if (chosen.size() > static_cast<std::size_t>(count)) chosen.resize(static_cast<std::size_t>(count));
  std::vector<rays::SurfacePoint> spread;
  for (const std::size_t i : chosen) spread.push_back(points[i]);
  return spread;
}

}  // namespace ssphh::transport
