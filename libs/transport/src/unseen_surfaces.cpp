#include "unseen_surfaces.h"

#include <algorithm>
#include <array>
#include <set>

#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>
#include <ssphh/transport/fitted_weights.h>

#include "network_data.h"
#include "point_cells.h"

namespace ssphh::transport {
namespace {

/// Points looked at, at most: a plain of kilometres has no end of voxels.
constexpr std::size_t most_points = 200'000;

std::vector<rays::PartPoint> spread_over(const rays::TransportSource& source, float size) {
  // As dense as voxels are, in steps from one point for each triangle
  const double enough = 4 / (static_cast<double>(size) * static_cast<double>(size));
  double density = enough;
  for (int step = 0; step < 16; ++step) density /= 4;
  std::vector<rays::PartPoint> points = source.sample_part(0, density);
  while (density < enough && points.size() < most_points) {
    density *= 4;
    points = source.sample_part(0, density);
  }
  return points;
}

/// What a point sees along few rays.
struct Look {
  static constexpr std::uint32_t count = 8;
  std::array<rays::RayQuery, count> rays;
  std::array<rays::RayHit, count> hits;
  std::ptrdiff_t backs;  ///< of surfaces

  Look(const rays::TransportSource& source, const rays::SurfacePoint& point, float lift) {
    const Frame frame = Frame::around(point.normal);
    for (std::uint32_t i = 0; i < count; ++i) {
      const vec2 u((static_cast<float>(i) + 0.5f) / count, static_cast<float>(i * 3 % count) / count);
      rays[i] = {point.position + lift * point.normal, frame.to_world(sample_cosine_hemisphere(u))};
    }
    source.intersect(0, rays, hits);
    backs = std::ranges::count_if(hits, [](const rays::RayHit& hit) { return hit.back; });
  }
  bool mostly_backs() const { return 2 * backs >= count; }
};

/// Whether another surface lies on the point's, or within `depth` before it: the underside of a pot that
/// stands on a table, of a road on the ground. Nobody sees it, and rays that start before it start within the
/// table.
bool is_covered(const rays::TransportSource& source, const rays::SurfacePoint& point, float depth) {
  constexpr float before = 0.9f;       // of the way to the point: what is met there is no part of its surface
  constexpr std::ptrdiff_t least = 2;  // of the rays: of surfaces in one plane either may be met
  const Frame frame = Frame::around(point.normal);
  std::array<rays::RayQuery, Look::count> rays;
  std::array<rays::RayHit, Look::count> hits;
  for (std::uint32_t i = 0; i < Look::count; ++i) {
    const float angle = 2 * pi * static_cast<float>(i) / Look::count;
    const vec3 away = depth * frame.to_world({0.3f * std::cos(angle), 0.3f * std::sin(angle), 1});
    rays[i] = {point.position + away, -away, 1.01f};
  }
  source.intersect(0, rays, hits);
  return std::ranges::count_if(hits, [&](const rays::RayHit& hit) {
           return !hit.escaped() && (hit.back || hit.distance < before);
         }) >= least;
}

/// Whether half of what the point sees is the back of surfaces; or some of it, and nothing is known to be
/// outside: where bodies touch, one shows its front within the other.
template <class Known>
bool is_inside(const rays::TransportSource& source, const rays::SurfacePoint& point, float lift,
               const Known& known) {
  const Look look(source, point, lift);
  if (look.backs == 0) return false;
  if (look.mostly_backs()) return true;
  for (std::uint32_t i = 0; i < Look::count; ++i) {
    const rays::RayHit& hit = look.hits[i];
    if (hit.escaped()) return false;
    if (!hit.back && known({look.rays[i].origin + hit.distance * look.rays[i].direction, hit.normal}))
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> within_bodies(std::span<const rays::SurfacePoint> points, const SurfelSet& surfels,
                                        const rays::TransportSource& source) {
  const PointGrid voxels{vec3(0), surfels.size()};
  const auto voxel = [&](const rays::SurfacePoint& point) {
    return voxels.cell(point, surfels.level(0, point.position));
  };
  const float lift = link_lift * surfels.size();
  std::vector<std::uint8_t> within(points.size());
  const float depth = std::max(lift, source.surface_gap());
  parallel_for(points.size(), 256, [&](std::size_t i) {
    within[i] = Look(source, points[i], lift).mostly_backs() || is_covered(source, points[i], depth);
  });
  std::set<PointCell> outside;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!within[i]) outside.insert(voxel(points[i]));
  const auto known = [&](const rays::SurfacePoint& point) { return outside.contains(voxel(point)); };
  parallel_for(points.size(), 256, [&](std::size_t i) {
    if (!within[i]) within[i] = is_inside(source, points[i], lift, known);
  });
  return within;
}

std::vector<rays::SurfacePoint> unseen_surfaces(const TransportNetwork& network,
                                                const rays::TransportSource& source,
                                                const probes::TileBox& within) {
  const SurfelSet& surfels = network.surfels();
  const PointGrid voxels{vec3(0), surfels.size()};
  const auto voxel = [&](const rays::SurfacePoint& point) {
    return voxels.cell(point, surfels.level(0, point.position));
  };
  std::set<PointCell> taken;
  for (const rays::SurfacePoint& point : surfel_points(network)) taken.insert(voxel(point));
  std::vector<rays::SurfacePoint> points;
  for (const rays::PartPoint& sample : spread_over(source, surfels.size())) {
    if (!within.contains(sample.point.position)) continue;
    for (const float side : {1.0f, -1.0f}) {
      const rays::SurfacePoint point{sample.point.position, side * sample.point.normal};
      if (!taken.contains(voxel(point))) points.push_back(point);
    }
  }
  std::vector<std::uint8_t> inside(points.size());
  const float lift = link_lift * surfels.size(), depth = std::max(lift, source.surface_gap());
  const auto known = [&](const rays::SurfacePoint& point) { return taken.contains(voxel(point)); };
  parallel_for(points.size(), 256, [&](std::size_t i) {
    inside[i] = is_inside(source, points[i], lift, known) || is_covered(source, points[i], depth);
  });
  std::vector<rays::SurfacePoint> unseen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!inside[i] && taken.insert(voxel(points[i])).second) unseen.push_back(points[i]);
  }
  return unseen;
}

}  // namespace ssphh::transport
