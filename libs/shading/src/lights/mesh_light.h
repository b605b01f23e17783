#pragma once
/// An emissive instance, or a flat lamp: its triangles are sampled by area, weighted by their mean emission;
/// of few that face several ways, by what each brings to the point.

#include <array>
#include <memory>

#include <ssphh/shading/lights.h>
#include <ssphh/shading/mesh_view.h>

#include "distribution.h"

namespace ssphh::shading {

class MeshLight {
 public:
  /// Keeps a reference to the scene.
  MeshLight(const scene::Scene& scene, const scene::Instance& instance, const mat4& world, int group);
  /// A flat lamp (scene/area_lamp.h) whose node stands at `world`.
  MeshLight(const scene::Light& lamp, const mat4& world, int group);

  bool empty() const { return choice_.empty(); }

  /// `u_choice` chooses the triangle, `u` the point on it.
  std::optional<LightSample> sample(const vec3& from, float u_choice, const vec2& u) const;
  /// The same from two numbers: the place of u.x within the chosen triangle's share serves again.
  std::optional<LightSample> sample(const vec3& from, const vec2& u) const;
  std::optional<EmittedPhoton> emit(const vec2& u_place, const vec2& u_direction) const;
  /// As LightSet::view_mesh.
  std::optional<MeshView> view(const vec3& position, const vec3& normal) const;
  float pdf(const vec3& from, std::uint32_t triangle, float distance, float cos_light) const;
  /// Where a ray meets the front of a flat lamp, with its radiance and the density of sample(); none beyond
  /// max_distance.
  std::optional<EmitterHit> intersect(const vec3& origin, const vec3& direction, float max_distance) const;

  float importance(const vec3& from) const;
  float power() const;
  const mat4& world() const { return world_; }
  const vec3& emission() const { return material_->emission; }
  int group() const { return group_; }
  const scene::Bounds& bounds() const { return bounds_; }

 private:
  /// What a flat lamp brings itself.
  struct Body {
    scene::Mesh mesh;
    scene::Material material;
  };
  struct Triangle {
    vec3 p0, e1, e2;
    vec3 normal;  ///< unit, front side
    float area;
    float strength;  ///< ∫ luminance of emission dA
  };
  MeshLight(const scene::Scene* scene, std::shared_ptr<const Body> body, const scene::Mesh& mesh,
            const scene::Material& material, const mat4& placed, const mat4& world, int group);
  static std::shared_ptr<const Body> body_of(const scene::Light& lamp);
  MeshLight(std::shared_ptr<const Body> body, const mat4& placed, const mat4& world, int group)
      : MeshLight(nullptr, body, body->mesh, body->material, placed, world, group) {}

  using Weights = std::array<float, MeshView::max_triangles>;

  /// What each triangle brings to a point, about, and in all; zero behind those that emit to their front.
  float weigh(const vec3& from, Weights& weights) const;
  Distribution::Choice choose(const vec3& from, float u) const;
  vec3 radiance(std::size_t triangle, const vec2& barycentric) const;
  std::optional<LightSample> sample(const vec3& from, const Distribution::Choice& choice,
                                    const vec2& u) const;

  const scene::Scene* scene_;  ///< of textures; null: a lamp, which has none
  std::shared_ptr<const Body> body_;
  const scene::Mesh* mesh_;
  const scene::Material* material_;
  mat4 world_;
  int group_;
  bool textured_;  ///< emission or coverage vary over the surface
  std::vector<Triangle> triangles_;
  Distribution choice_;   ///< by strength
  bool by_view_ = false;  ///< triangles are chosen by weigh()
  float strength_ = 0;    ///< ∫ luminance of emission dA
  scene::Bounds bounds_;
  vec3 center_{0};
  float extent2_ = 0;  ///< squared radius around the centre
  std::optional<vec3>
      facing_;  ///< the normal, where all triangles lie in one plane and only their front emits
};

}  // namespace ssphh::shading
