#pragma once
/// The scene's own lights, as trace_path asks for them.

#include "path.h"

namespace ssphh::trace {

class SceneEmitters {
 public:
  /// `found_by_rays`: whether the scene has lights that are not points in space or direction.
  SceneEmitters(const shading::LightSet& lights, bool found_by_rays)
      : lights_(lights), found_by_rays_(found_by_rays) {}

  template <class Visit>
  void along(int /*depth*/, const PathVertex& /*vertex*/, const Ray& ray, float distance,
             const Visit& visit) const {
    if (!found_by_rays_) return;
    const auto found = [&](const shading::EmitterHit& e) {
      visit(e.group, e.radiance, e.pdf, -ray.direction);
    };
    lights_.intersect_spheres(ray.origin, ray.direction, distance, [&](const shading::EmitterHit& e) {
      if (e.distance >= ray.t_min) found(e);
    });
    if (std::isinf(distance)) lights_.escaped(ray.direction, found);
  }

  template <class Visit>
  void surface(const PathVertex& vertex, const Ray& ray, const Hit& hit, const shading::Surface& surface,
               const Visit& visit) const {
    const float cos_light = std::abs(glm::dot(surface.geometric_normal, ray.direction));
    const float pdf =
        lights_.pdf_triangle(vertex.position, hit.instance, hit.triangle, hit.distance, cos_light);
    visit(lights_.instance_group(hit.instance), surface.emission, pdf, -ray.direction);
  }

  std::optional<shading::LightSample> sample(const PathVertex& vertex, float u_choice, const vec2& u) const {
    return lights_.sample(vertex.position, u_choice, u);
  }

  bool found_by_rays() const { return found_by_rays_; }

 private:
  const shading::LightSet& lights_;
  bool found_by_rays_;
};

}  // namespace ssphh::trace
