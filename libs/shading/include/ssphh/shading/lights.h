#pragma once
/// All emitters of a posed scene as one sampling distribution, with the group each belongs to.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/held.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/scene.h>

namespace ssphh::shading {

/// One way from a surface point to a light.
struct LightSample {
  vec3 wi;         ///< unit, world space, from the point toward the light
  float distance;  ///< metres to the light, to its surface if it has one; infinity for distant ones
  vec3 radiance;   ///< incident radiance (not divided by pdf); for delta lights the incident irradiance on a
                   ///< plane that faces wi
  float pdf;   ///< solid-angle density times the probability of choosing this light; delta: that probability
  bool delta;  ///< cannot be hit by a scattered ray: no MIS
  int group;
};

/// What a ray that hits a sphere or a flat lamp, or escapes, finds.
struct EmitterHit {
  float distance;
  vec3 radiance;
  float pdf;  ///< the density with which sample() would have chosen this direction from the ray's origin
  int group;
};

/// A photon as it leaves emitter i.
struct EmittedPhoton {
  rays::Photon photon;
  vec3 normal{0};  ///< of the emissive surface on the photon's side; zero: no surface
};

class MeshView;

/// `mesh`: an emissive instance or a flat lamp.
enum class EmitterKind { point, sphere, mesh, directional, disc, environment };

/// One emitter of a LightSet.
struct Emitter {
  EmitterKind kind;
  int group;
  /// World-space box around it; of `directional`, `disc` and `environment` the box around the unit directions
  /// toward it.
  scene::Bounds extent;

  bool delta() const { return kind == EmitterKind::point || kind == EmitterKind::directional; }
  bool distant() const { return kind >= EmitterKind::directional; }
};

class LightSet {
 public:
  /// Reads all lights, emissive instances and the environment of `scene` posed by `world`, emission as it is
  /// at `time` seconds. Keeps a reference to the scene.
  LightSet(const scene::Scene& scene, const std::vector<mat4>& world, float time = 0);
  LightSet(const scene::Scene&&, const std::vector<mat4>&, float = 0) = delete;  // it would be gone
  /// The emitters of `base`'s scene with its lights as `lights` say, one state per scene::Light, and its
  /// emissive instances posed by `world`, and its environment as it is now. What has not moved is shared with
  /// `base`.
  LightSet(const LightSet& base, const std::vector<mat4>& world, std::span<const scene::LightState> lights,
           const scene::EnvironmentState& environment = {});
  /// Becomes LightSet(base, …) where it was made of the same base, in its own memory: allocates nothing where
  /// emissive instances stand still, and the environment stays as it was.
  void pose(const LightSet& base, const std::vector<mat4>& world, std::span<const scene::LightState> lights,
            const scene::EnvironmentState& environment = {});
  /// The emitters of other light groups than these; what both have is shared.
  LightSet without(std::span<const int> groups) const;
  ~LightSet();
  LightSet(LightSet&&) noexcept;
  LightSet& operator=(LightSet&&) noexcept;

  bool empty() const;
  const std::vector<std::string>& groups() const;

  /// How many samples give all light at a point: one of the lamps and emissive meshes, and one of what is
  /// distant, where there are such. Which of the two is worth more no point can tell: walls may hide either.
  int sample_count() const;
  /// Chooses a light of sample i < sample_count(), and a point on it as seen from `position`. `u_choice` in
  /// [0, 1), `u` in [0, 1)². Empty when the chosen one cannot light the point.
  std::optional<LightSample> sample(int i, const vec3& position, float u_choice, const vec2& u) const;

  /// The emitters one by one, those that are off left out.
  int emitter_count() const;
  Emitter emitter(int i) const;
  /// A sample of emitter i alone: `pdf` holds no probability of a choice and is 1 where `delta`.
  /// Stratified `u` give stratified samples.
  std::optional<LightSample> sample_emitter(int i, const vec3& position, const vec2& u) const;
  /// Luminance of the flux of emitter i [W]; of distant ones, through a sphere of `radius` metres.
  float flux(int i, float radius) const;
  /// A photon of emitter i; of distant ones, on its way into the sphere around `center`. Stratified numbers
  /// give stratified photons. Sphere lights send photons outward only.
  std::optional<EmittedPhoton> emit(int i, const vec2& u_place, const vec2& u_direction, const vec3& center,
                                    float radius) const;
  /// Emissive mesh or flat lamp i as a surface point sees it; empty for other emitters, and for meshes that
  /// have no closed form: textured, of partial coverage, or with more than MeshView::max_triangles triangles.
  std::optional<MeshView> view_mesh(int i, const vec3& position, const vec3& normal) const;
  /// Radiance from distant emitter i in a direction, with the density of sample_emitter; empty beside a disc
  /// and for delta lights.
  std::optional<EmitterHit> distant_radiance(int i, const vec3& direction) const;

  /// Density of sample() for the point of an emissive triangle hit by a ray: `instance` and `triangle` as in
  /// the scene, `cos_light` the absolute cosine at the light, `distance` from `position`. Zero when the
  /// triangle is not a light.
  float pdf_triangle(const vec3& position, int instance, std::uint32_t triangle, float distance,
                     float cos_light) const;

  /// Group of an emissive instance; −1 when the instance does not emit.
  int instance_group(int instance) const;

  /// All sphere lights, and fronts of flat lamps, that the ray meets before max_distance (they neither block
  /// nor reflect). Calls visit(EmitterHit) for each.
  template <class Visit>
  void intersect_lamps(const vec3& origin, const vec3& direction, float max_distance, Visit&& visit) const {
    for (int i = 0; i < lamp_count(); ++i) {
      if (const auto hit = intersect_lamp(i, origin, direction, max_distance)) visit(*hit);
    }
  }

  /// Environment and distant discs (a sun with angular radius) in a direction. Calls visit(EmitterHit) for
  /// each.
  template <class Visit>
  void escaped(const vec3& direction, Visit&& visit) const {
    for (int i = 0; i < distant_count(); ++i) {
      if (const auto hit = distant(i, direction)) visit(*hit);
    }
  }

 private:
  LightSet();
  int lamp_count() const;
  std::optional<EmitterHit> intersect_lamp(int i, const vec3& origin, const vec3& direction,
                                           float max_distance) const;
  int distant_count() const;
  std::optional<EmitterHit> distant(int i, const vec3& direction) const;

  struct Data;
  Held<Data> data_;
};

/// Power heuristic (β = 2) of multiple importance sampling.
inline float power_heuristic(float pdf, float other_pdf) {
  if (!(pdf > 0)) return 0;
  const float ratio = other_pdf / pdf;  // squaring the densities themselves could overflow
  return 1 / (1 + ratio * ratio);
}

}  // namespace ssphh::shading
