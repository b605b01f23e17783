#pragma once
/// An emissive instance: its triangles are sampled by area, weighted by their mean emission.

#include <ssphh/shading/lights.h>
#include <ssphh/shading/mesh_view.h>

#include "distribution.h"

namespace ssphh::shading {

class MeshLight {
 public:
  /// Keeps a reference to the scene.
  MeshLight(const scene::Scene& scene, const scene::Instance& instance, const mat4& world, int group);

  bool empty() const { return choice_.empty(); }

  /// `u_choice` chooses the triangle, `u` the point on it.
  std::optional<LightSample> sample(const vec3& from, float u_choice, const vec2& u) const;
  /// The same from two numbers: the place of u.x within the chosen triangle's share serves again.
  std::optional<LightSample> sample(const vec3& from, const vec2& u) const;
  std::optional<EmittedPhoton> emit(const vec2& u_place, const vec2& u_direction) const;
  /// As LightSet::view_mesh.
  std::optional<MeshView> view(const vec3& position, const vec3& normal) const;
  float pdf(const vec3& from, std::uint32_t triangle, float distance, float cos_light) const;

  float importance(const vec3& from) const;
  float power() const;
  const mat4& world() const { return world_; }
  int group() const { return group_; }
  const scene::Bounds& bounds() const { return bounds_; }

 private:
  struct Triangle {
    vec3 p0, e1, e2;
    vec3 normal;  ///< unit, front side
    float area;
  };
  vec3 radiance(std::size_t triangle, const vec2& barycentric) const;
  std::optional<LightSample> sample(const vec3& from, const Distribution::Choice& choice,
                                    const vec2& u) const;

  const scene::Scene* scene_;
  const scene::Mesh* mesh_;
  const scene::Material* material_;
  mat4 world_;
  int group_;
  bool textured_;  ///< emission or coverage vary over the surface
  std::vector<Triangle> triangles_;
  Distribution choice_;
  float strength_ = 0;  ///< ∫ luminance of emission dA
  scene::Bounds bounds_;
  vec3 center_{0};
  float extent2_ = 0;  ///< squared radius around the centre
  std::optional<vec3>
      facing_;  ///< the normal, where all triangles lie in one plane and only their front emits
};

}  // namespace ssphh::shading
