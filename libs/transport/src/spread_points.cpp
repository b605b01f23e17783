#include <algorithm>

#include <ssphh/core/error.h>
#include <ssphh/core/require.h>
#include <ssphh/transport/fitted_weights.h>

#include "point_cells.h"

namespace ssphh::transport {

std::vector<rays::SurfacePoint> spread_points(std::span<const rays::SurfacePoint> points, int count,
                                              std::span<const int> levels) {
  if (count < 1) throw Error("points to spread", "there must be at least one");
  require(levels.empty() || levels.size() == points.size(), "points to spread",
          "not every point has its level");
  if (points.size() <= static_cast<std::size_t>(count)) return {points.begin(), points.end()};
  std::vector<std::size_t> chosen;
  for (const auto& [cell, members] : finest_grid(points, levels, count).sort(points, levels))
    chosen.push_back(middle_one(points, members));
  std::ranges::sort(chosen);
  if (chosen.size() > static_cast<std::size_t>(count)) chosen.resize(static_cast<std::size_t>(count));
  std::vector<rays::SurfacePoint> spread;
  for (const std::size_t i : chosen) spread.push_back(points[i]);
  return spread;
}

}  // namespace ssphh::transport
