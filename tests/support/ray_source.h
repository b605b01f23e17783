#pragma once
/// A TransportSource without triangles: the test says in closed form what a ray meets.

#include <functional>

#include "unlit_source.h"

namespace ssphh::test {

class RaySource final : public UnlitSource {
 public:
  using Meets = std::function<rays::RayHit(const vec3& origin, const vec3& direction)>;
  explicit RaySource(Meets meets) : meets_(std::move(meets)) {}

  scene::Bounds part_bounds(int) const override { return {vec3(-1), vec3(1)}; }
  void intersect(int, std::span<const rays::RayQuery> rays, std::span<rays::RayHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = meets_(rays[i].origin, rays[i].direction);
  }
  void occluded(int, std::span<const rays::RayQuery> rays, std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i)
      blocked[i] = meets_(rays[i].origin, rays[i].direction).distance < rays[i].t_max;
  }

 private:
  Meets meets_;
};

/// A surface that faces the ray, or shows its back.
inline rays::RayHit surface_at(float distance, const vec3& direction, bool back = false) {
  rays::RayHit hit;
  hit.distance = distance;
  hit.normal = -direction;
  hit.back = back;
  return hit;
}

}  // namespace ssphh::test
