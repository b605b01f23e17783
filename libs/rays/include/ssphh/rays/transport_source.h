#pragma once
/// Questions about surfaces and lamps that light transport between probes asks, without knowing who answers
/// (Embree here; a GPU may answer them too). Bodies that move are kept apart from those that never do, so
/// that a door which swings asks for little. Answers are a pure function of the scene and the arguments.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/require.h>
#include <ssphh/rays/surface_point.h>
#include <ssphh/scene/lighting_state.h>
#include <ssphh/scene/query.h>

namespace ssphh::rays {

/// Ray or segment: covers the distances (0, t_max) in units of `direction`, which need not be a unit vector.
struct RayQuery {
  vec3 origin{0};
  vec3 direction{0, 0, -1};
  float t_max = std::numeric_limits<float>::infinity();
};

/// The nearest surface on a ray, as transport sees it: Lambertian.
struct RayHit {
  float distance = std::numeric_limits<float>::infinity();  ///< in units of the direction; infinite: escaped
  vec3 normal{0};                                           ///< geometric, unit, toward the ray's origin
  vec3 albedo{0};     ///< share of the irradiance that leaves again, diffuse and specular, 0..1
  vec3 emission{0};   ///< radiance toward the ray's origin [W sr⁻¹ m⁻²]
  int group = -1;     ///< light group of the emission; −1: none
  bool back = false;  ///< the back of a one-sided surface was hit
  /// What glass of the same part leaves of the light that comes along the ray. Rays go straight through
  /// glass, which is no surface to them.
  vec3 through{1};

  bool escaped() const { return !(distance < std::numeric_limits<float>::infinity()); }
};

/// A ray after a sheet of glass has mirrored it.
struct MirroredRay {
  std::uint32_t of = 0;  ///< index of the ray
  RayQuery ray;          ///< from the sheet on; without end
  /// The share of the light along it, glass on its own way left out, that arrives at the origin of the ray
  /// that it was.
  vec3 share{0};
};

/// A place on a part that sample_part chose.
struct PartPoint {
  SurfacePoint point;  ///< in the part's frame, front side
  vec3 albedo{0};
  bool double_sided = false;
};

/// Light on its way from an emitter.
struct Photon {
  vec3 origin{0};
  vec3 direction{0, 0, -1};  ///< unit
  vec3 power{0};  ///< [W], divided by the density it was chosen with: its mean is what the emitters send out
  float range = 0;  ///< of its light [m]: what arrives is held back by range_share; 0: nothing is

  /// Share of the power that arrives after `distance` metres (KHR_lights_punctual's recommended falloff).
  float range_share(float distance) const {
    const float r = distance / range;
    return range > 0 ? glm::clamp(1 - r * r * r * r, 0.0f, 1.0f) : 1;
  }
};

/// Light that arrives at a place along one way.
struct ArrivingLight {
  vec3 toward{0, 1, 0};  ///< unit, toward the emitter
  vec3 irradiance{0};    ///< [W/m²] on a plane that faces it
};

/// Uniform numbers in [0, 1) that choose a photon.
struct PhotonNumbers {
  float emitter = 0;
  vec2 place{0}, direction{0};
};

/// Light that comes straight from emitters, for one state of the lights and one pose of the parts.
/// Implemented by what trace::TransportScene::direct_light returns. All calls may come from several threads
/// at once.
class DirectLight {
 public:
  virtual ~DirectLight() = default;
  /// Irradiance [W/m²] at each point from one light group, shadowed by everything. Exact for lights that are
  /// points; a stratified estimate, the same at every call, for those with an extent and for the environment.
  virtual void irradiance(int group, std::span<const SurfacePoint> points, std::span<vec3> out) const = 0;
  /// Whether a body inside `box` may change the group's light at the point; false only if it cannot.
  virtual bool may_shadow(int /*group*/, const SurfacePoint& /*point*/, const scene::Bounds& /*box*/) const {
    return true;
  }
  /// Radiance of the group's emitters that are no surfaces (sphere lights, environment, a sun's disc) along a
  /// world-space ray whose nearest surface is at `distance`, infinite if it escapes: darkness there is
  /// darkness at any distance.
  virtual vec3 emitted(int /*group*/, const RayQuery& /*ray*/, float /*distance*/) const { return vec3(0); }
  /// The group's light at a surface point, from so many samples of each of its emitters, more where they are
  /// partly hidden, the same at every call: for light that is kept, where noise would stay.
  virtual IrradianceByNormal irradiance_by_normal(int /*group*/, const SurfacePoint& /*point*/,
                                                  int /*samples*/) const {
    refuse("direct light", "it cannot tell irradiance by normal");
  }
  /// The group's light at a place in the open, likewise: with f of the directions summed, ∫ L f dω.
  virtual std::vector<ArrivingLight> arriving(int /*group*/, const vec3& /*place*/, int /*samples*/) const {
    refuse("direct light", "it cannot tell what arrives in the open");
  }
  /// Whether there are panes that mirror light of emitters: flat sheets of glass that stand still. They do
  /// so for emitters with an extent and the environment; what follows adds it to nothing above.
  virtual bool mirrors() const { return false; }
  /// Irradiance [W/m²] at each point by the group's light that one pane has mirrored.
  virtual void mirrored(int /*group*/, std::span<const SurfacePoint> /*points*/, std::span<vec3> out) const {
    for (vec3& e : out) e = vec3(0);
  }
  /// As irradiance_by_normal() of it.
  virtual IrradianceByNormal mirrored_by_normal(int /*group*/, const SurfacePoint& /*point*/,
                                                int /*samples*/) const {
    return IrradianceByNormal(0);
  }
  /// As arriving() of it.
  virtual std::vector<ArrivingLight> mirrored_arriving(int /*group*/, const vec3& /*place*/,
                                                       int /*samples*/) const {
    return {};
  }
  /// Luminance of the flux [W] that the group's emitters send out; of those at infinity, through the sphere
  /// around the surfaces. Near enough to share photons out by.
  virtual float flux(int /*group*/) const { refuse("direct light", "it cannot emit photons"); }
  /// A photon of the group's emitters, which arrives at surfaces as irradiance() has it; none where `numbers`
  /// fall on darkness.
  virtual std::optional<Photon> emit(int /*group*/, const PhotonNumbers& /*numbers*/) const {
    refuse("direct light", "it cannot emit photons");
  }
  /// Places on the group's emitters that have a surface and whose box is no wider than `widest` metres along
  /// any axis: `count` or somewhat more, at least one on each that shines, more where more light leaves. The
  /// same at every call; none where the source does not tell.
  virtual std::vector<vec3> emitter_places(int /*group*/, float /*widest*/, int /*count*/) const {
    return {};
  }
};

class RadianceSource;

/// Implemented by trace::TransportScene. All calls may come from several threads at once, but
/// renew_direct_light() for one `light`. What has a body here answers for a world in which nothing moves and
/// that has no lamps to turn: the rest is an own ray tracer (examples/own_rays.cpp).
class TransportSource {
 public:
  virtual ~TransportSource() = default;

  /// 1 + number of moving parts. Part 0 is all that never moves, in world space; every other part is rigid in
  /// its own frame.
  virtual int part_count() const { return 1; }
  virtual const std::string& part_name(int part) const;
  /// In the part's frame; empty for a part without triangles.
  virtual scene::Bounds part_bounds(int part) const = 0;
  /// Seconds after which nothing moves any more.
  virtual float duration() const { return 0; }
  /// Part to world at `time` seconds; the identity for part 0.
  virtual mat4 part_pose(int part, float time) const;
  /// Points of a part that moves, uniform by area, at least one per triangle; the same at every call.
  virtual std::vector<PartPoint> sample_part(int part, double points_per_square_metre) const;

  /// Nearest hit of each ray with one part alone, rays and hits in the part's frame.
  virtual void intersect(int part, std::span<const RayQuery> rays, std::span<RayHit> hits) const = 0;
  /// Rays that sheets of glass of the part mirror before they end; `hits` are what intersect() tells of them.
  /// One at most for each ray, in their order: where several sheets are on its way, the ray's bits choose one
  /// as light does, with a share that makes up for the others. In the part's frame.
  virtual std::vector<MirroredRay> mirrored(int /*part*/, std::span<const RayQuery> /*rays*/,
                                            std::span<const RayHit> /*hits*/) const {
    return {};
  }
  /// blocked[i] = 1 where the part alone meets segment i, else 0; in the part's frame.
  /// What intersect() tells.
  virtual void occluded(int part, std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const;
  /// Whether the part alone neither meets the segment nor has glass on it that dims light; in the part's
  /// frame. What intersect() tells; a source that knows it for less says so here.
  virtual bool joined(int part, const RayQuery& segment) const;
  /// Height above points at which the rays of direct_light() start [m]: what stands nearer before a point
  /// casts no shadow on it.
  virtual float surface_gap() const { return 0; }

  virtual const std::vector<std::string>& light_groups() const = 0;
  /// The scene's lights posed at `time`, in the scene's order.
  virtual std::vector<scene::LightState> lights(float time) const;
  /// Names and group indices of lights(), in the same order.
  virtual const std::vector<std::string>& light_names() const;
  virtual int light_group_of(int light) const;
  /// Whether the group has emitters beside lights(): emissive meshes on the given part. Part 0 also stands
  /// for the environment.
  virtual bool group_emits_from(int group, int part) const;
  /// Group index of the environment; −1: there is none.
  virtual int environment_group() const { return -1; }
  /// `lights` as from lights(), perhaps changed; `poses` one matrix per part; the environment as
  /// it is now.
  virtual std::unique_ptr<DirectLight> direct_light(
      std::span<const scene::LightState> lights, std::span<const mat4> poses,
      const scene::EnvironmentState& environment = {}) const = 0;

  /// The same in place of what direct_light() gave before; null: nothing yet. A source that is asked every
  /// frame makes its own anew without taking memory. When it throws, `light` may be neither the old nor the
  /// new one.
  virtual void renew_direct_light(std::unique_ptr<DirectLight>& light,
                                  std::span<const scene::LightState> lights, std::span<const mat4> poses,
                                  const scene::EnvironmentState& environment) const {
    light = direct_light(lights, poses, environment);
  }

  /// Path tracing of the scene in that state, whose SPHLs do not shine. What it returns may outlive this
  /// object, but not the scene.
  virtual std::unique_ptr<RadianceSource> path_tracing(const scene::LightingState& state) const;

  /// Rays traced so far by this object and its DirectLights; 0 of one that does not count.
  virtual std::uint64_t rays_traced() const { return 0; }
};

/// The source's own lights as they are at `time` seconds, every group at its full strength.
scene::LightingState lighting_at(const TransportSource& source, float time = 0);

}  // namespace ssphh::rays
