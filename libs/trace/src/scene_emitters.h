#pragma once
/// The scene's own lights, as trace_path asks for them.

#include "found_by_rays.h"
#include "path.h"

namespace ssphh::trace {

class SceneEmitters {
 public:
  /// `sampled`: those whose light comes straight to surfaces with a lookup. `mirrored`, if not null: those
  /// that such surfaces mirror, too, but have from the lookup otherwise. `held`, if not null: all that they
  /// have from it, which rays find that follow their specular lobe.
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
    for_lights_at(vertex, [&](const shading::LightSet& lights, const vec3& share) {
      const auto found = [&](const shading::EmitterHit& e) {
        visit(e.group, share * e.radiance, e.pdf, -ray.direction);
      };
      lights.intersect_lamps(ray.origin, ray.direction, distance, [&](const shading::EmitterHit& e) {
        if (e.distance >= ray.t_min) found(e);
      });
      if (std::isinf(distance)) lights.escaped(ray.direction, found);
    });
  }

  template <class Visit>
  void surface(const PathVertex& vertex, const Ray& ray, const Hit& hit, const shading::Surface& surface,
               const Visit& visit) const {
    if (vertex.followed && !held_) return;
    for_lights_at(vertex, [&](const shading::LightSet& lights, const vec3& share) {
      const int group = lights.instance_group(hit.instance);
      if (group < 0) return;
      const float cos_light = std::abs(glm::dot(surface.geometric_normal, ray.direction));
      const float pdf =
          lights.pdf_triangle(vertex.position, hit.instance, hit.triangle, hit.distance, cos_light);
      visit(group, share * surface.emission, pdf, -ray.direction);
    });
  }

  int sample_count(const PathVertex& vertex) const { return lights_at(vertex).sample_count(); }
  std::optional<shading::LightSample> sample(int i, const PathVertex& vertex, float u_choice,
                                             const vec2& u) const {
    return lights_at(vertex).sample(i, vertex.position, u_choice, u);
  }
  /// Of those that surfaces with a lookup mirror; there are some.
  int mirrored_sample_count() const { return mirrored_->sample_count(); }
  std::optional<shading::LightSample> sample_mirrored(int i, const PathVertex& vertex, float u_choice,
                                                      const vec2& u) const {
    return mirrored_->sample(i, vertex.position, u_choice, u);
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
  /// Whether there are any for rays that follow their specular lobe.
  bool held() const { return held_ != nullptr; }

 private:
  template <class Visit>
  void for_lights_at(const PathVertex& vertex, const Visit& visit) const {
    visit(lights_at(vertex), vec3(1));
    if (mirrored_ && vertex.looked_up && vertex.mirrored != vec3(0)) visit(*mirrored_, vertex.mirrored);
  }
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
