#pragma once
/// The scene's own lights, as trace_path asks for them.

#include "found_by_rays.h"
#include "path.h"

namespace ssphh::trace {

class SceneEmitters {
 public:
  /// `sampled`: those whose light comes straight to surfaces with a lookup. `mirrored`, if not null: those at
  /// infinity that such surfaces mirror, too, but have from the lookup otherwise. `held`, if not null: all
  /// that they have from it, which rays find that follow their specular lobe.
  SceneEmitters(const shading::LightSet& lights, const shading::LightSet& sampled,
                const shading::LightSet* mirrored = nullptr, const shading::LightSet* held = nullptr)
      : lights_(lights),
        sampled_(sampled),
        mirrored_(mirrored),
        held_(held),
        by_rays_(lights),
        sampled_by_rays_(sampled) {}
  explicit SceneEmitters(const shading::LightSet& lights) : SceneEmitters(lights, lights) {}

  template <class Visit>
  void along(int /*depth*/, const PathVertex& vertex, const Ray& ray, float distance,
             const Visit& visit) const {
    if (!found_by_rays(vertex)) return;
    const shading::LightSet& lights = lights_at(vertex);
    const auto found = [&](const shading::EmitterHit& e) {
      visit(e.group, e.radiance, e.pdf, -ray.direction);
    };
    lights.intersect_lamps(ray.origin, ray.direction, distance, [&](const shading::EmitterHit& e) {
      if (e.distance >= ray.t_min) found(e);
    });
    if (!std::isinf(distance)) return;
    lights.escaped(ray.direction, found);
    if (mirrored_ && vertex.looked_up && vertex.mirrored != vec3(0))
      mirrored_->escaped(ray.direction, [&](const shading::EmitterHit& e) {
        visit(e.group, vertex.mirrored * e.radiance, 0, -ray.direction);  // nothing else finds it
      });
  }

  template <class Visit>
  void surface(const PathVertex& vertex, const Ray& ray, const Hit& hit, const shading::Surface& surface,
               const Visit& visit) const {
    if (vertex.followed && !held_) return;
    const shading::LightSet& lights = lights_at(vertex);
    const int group = lights.instance_group(hit.instance);
    if (group < 0) return;
    const float cos_light = std::abs(glm::dot(surface.geometric_normal, ray.direction));
    const float pdf =
        lights.pdf_triangle(vertex.position, hit.instance, hit.triangle, hit.distance, cos_light);
    visit(group, surface.emission, pdf, -ray.direction);
  }

  std::optional<shading::LightSample> sample(const PathVertex& vertex, float u_choice, const vec2& u) const {
    return lights_at(vertex).sample(vertex.position, u_choice, u);
  }

  bool found_by_rays(const PathVertex& vertex) const {
    if (vertex.followed) return held_ != nullptr;
    return vertex.looked_up ? sampled_by_rays_.any() || vertex.mirrored != vec3(0) : by_rays_.any();
  }
  bool may_meet(const PathVertex& vertex, const Ray& ray) const {
    return vertex.looked_up ? sampled_by_rays_.on(ray) || vertex.mirrored != vec3(0) : by_rays_.on(ray);
  }
  /// Whether surfaces with a lookup mirror emitters that it holds.
  bool mirrored() const { return mirrored_ != nullptr; }

 private:
  const shading::LightSet& lights_at(const PathVertex& vertex) const {
    if (vertex.followed && held_) return *held_;
    return vertex.looked_up ? sampled_ : lights_;
  }

  const shading::LightSet& lights_;
  const shading::LightSet& sampled_;
  const shading::LightSet *mirrored_ = nullptr, *held_ = nullptr;
  FoundByRays by_rays_, sampled_by_rays_;
};

}  // namespace ssphh::trace
