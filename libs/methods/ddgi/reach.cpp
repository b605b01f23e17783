#include "reach.h"

#include <algorithm>

#include <ssphh/rays/posed_world.h>

#include "points_in_reach.h"

namespace ssphh::methods::ddgi {
namespace {

constexpr int points_per_pose = 1024;

struct OpenPoint {
  rays::SurfacePoint point;
  float way;  ///< along the normal to what is opposite [m]
};

std::vector<OpenPoint> points_at(const MethodScene& scene, float time, const Control& control) {
  const rays::PosedWorld surfaces(scene.source, time);
  const float lift = 1e-4f * surfaces.bounds().radius();
  std::vector<OpenPoint> open;
  std::vector<rays::RayQuery> rays;
  for (const rays::SurfacePoint& point : points_in_reach(scene, time, points_per_pose, control)) {
    open.push_back({point, 0});
    rays.push_back({point.position + lift * point.normal, point.normal});
  }
  std::vector<rays::RayHit> hits(rays.size());
  surfaces.intersect(rays, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) open[i].way = hits[i].distance;
  return open;
}

}  // namespace

ProbeGrid grid_in_reach(const MethodScene& scene, float spacing, int probes, int most,
                        const Control& control) {
  std::vector<OpenPoint> open;
  const float duration = scene.source.duration();
  for (const float time : {0.0f, 0.5f * duration, duration}) {
    const std::vector<OpenPoint> posed = points_at(scene, time, control);
    open.insert(open.end(), posed.begin(), posed.end());
    if (!(duration > 0)) break;
  }
  const auto bounds = [&](float air) {
    scene::Bounds all;
    for (const auto& [point, way] : open) {
      all.add(point.position);
      all.add(point.position + std::min(air, 0.5f * way) * point.normal);
    }
    return all;
  };
  const ProbeGrid tight = make_grid(bounds(0), spacing, probes, most);
  return make_grid(bounds(tight.least_spacing()), spacing, probes, most);
}

}  // namespace ssphh::methods::ddgi
