#include "points_in_reach.h"

#include <ssphh/place/place.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/study/surface_points.h>

namespace ssphh::methods {

std::vector<rays::SurfacePoint> points_in_reach(const MethodScene& scene, float time, int count,
                                                const Control& control) {
  const place::PlaceParams seen_from = place::place_params(scene.scene, time);
  std::vector<vec3> origins = seen_from.interest;
  for (const scene::ProbePlace& place : seen_from.manual) origins.push_back(place.position);
  if (origins.empty()) origins.push_back(rays::PosedWorld(scene.source, time).bounds().center());
  return study::reachable_points(scene.source, origins, time, {count, 0}, {nullptr, control.cancel});
}

std::vector<vec3> scaled_direct(const rays::DirectLight& lights, std::span<const vec3> group_scales,
                                std::span<const rays::SurfacePoint> points) {
  std::vector<vec3> sum(points.size(), vec3(0)), of_group(points.size());
  for (std::size_t g = 0; g < group_scales.size(); ++g) {
    if (group_scales[g] == vec3(0)) continue;
    lights.irradiance(static_cast<int>(g), points, of_group);
    for (std::size_t i = 0; i < points.size(); ++i) sum[i] += group_scales[g] * of_group[i];
  }
  return sum;
}

}  // namespace ssphh::methods
