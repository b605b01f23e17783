#pragma once
/// Cubes of grids that halve from level to level, by which points of surfaces are spread.

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::transport {

/// A cube of some level, and the side of it that a normal faces most.
using PointCell = std::tuple<int, long, long, long, int>;
using PointCells = std::map<PointCell, std::vector<std::size_t>>;

/// Cubes of level k have the edge 2ᵏ · `size`; those of a level are made of eight of the level below.
struct PointGrid {
  vec3 origin;
  float size;  ///< [m]

  PointCell cell(const rays::SurfacePoint& point, int level) const;
  /// The points of each cube that holds any, each point in one of its own level; without levels all are 0.
  PointCells sort(std::span<const rays::SurfacePoint> points, std::span<const int> levels) const;
};

/// That of the smallest cubes, within one per cent, of which no more than `count` hold points. Throws Error
/// for a place that is not finite; there is at least one point.
PointGrid finest_grid(std::span<const rays::SurfacePoint> points, std::span<const int> levels, int count);

/// Of the points of a cube, the one nearest to the middle of all.
std::size_t middle_one(std::span<const rays::SurfacePoint> points, std::span<const std::size_t> members);

}  // namespace ssphh::transport
