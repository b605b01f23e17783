#pragma once
/// Questions about the light in a scene that probe methods ask, without knowing who answers (a path tracer
/// here, a farm of workers, a GPU). Answers are a pure function of the scene and the request.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/image/cube_map.h>
#include <ssphh/rays/path_set.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/query.h>

namespace ssphh::rays {

/// Scattering events that stand for every bounce: a white room keeps 6 % of its light so long, one of albedo
/// 0.7 a ten-thousandth.
inline constexpr int usual_max_depth = 25;

/// Sampling effort and light paths (docs/conventions.md#light-paths).
struct PathParams {
  int max_depth = usual_max_depth;  ///< surface scattering events; 0 sees emitters only
  int passes = 1;                   ///< progressive passes of `spp` samples each
  int spp = 16;                     ///< samples per pixel or texel and pass
  std::uint64_t seed = 0;
};

/// A sphere of radiance 1 in every direction, seen by camera and scattering rays but never blocking or
/// reflecting: the emitter of VIZ.
struct GhostSphere {
  vec3 center;
  float radius;
};

/// One path from a probe to a ghost sphere: what `matrix` transport integrates.
struct GhostPath {
  int emitter;      ///< index of the ghost sphere
  vec3 direction;   ///< ω_i at the probe, away from it
  vec3 emission;    ///< ω_e, the direction in which the sphere emitted the path's light
  vec3 throughput;  ///< radiance contribution times the texel's solid angle / samples: sums to ∫ L dω
};

struct CubeRequest {
  vec3 position{0};
  int face_size = 64;
  PathParams path;
  PathSet paths = PathSet::all;
};

/// Radiance arriving at a point from one light group, in two fields, so that no light is counted twice: a
/// surface that also gets direct light must look up `reflected` only; a viewer of the probe sees the sum.
struct GroupRadiance {
  image::CubeMap
      emitted;  ///< depth 0: the group's emitters seen directly (area and sphere lights, environment)
  image::CubeMap reflected;  ///< depth 1..max_depth: light that a surface scattered toward the point
};

/// Path-traced light at a surface point: the truth that lookups are measured against.
struct IrradianceEstimate {
  vec3 direct{0};               ///< irradiance [W/m²] straight from emitters
  vec3 indirect{0};             ///< irradiance by light that other surfaces scattered
  vec3 indirect_variance{0};    ///< of the estimate `indirect`, from independent batches
  vec3 indirect_covariance{0};  ///< of the same: red with green, green with blue, blue with red
};

/// Implemented by trace::PathTracer. All calls may come from several threads at once. What has a body here
/// refuses or answers for a source that cannot tell: baking without VIZ asks for the rest alone.
class RadianceSource {
 public:
  virtual ~RadianceSource() = default;

  /// Names of the light groups, in the order of incident_radiance's result.
  virtual const std::vector<std::string>& light_groups() const = 0;

  /// Radiance arriving at a point, one entry per light group.
  virtual std::vector<GroupRadiance> incident_radiance(const CubeRequest& request,
                                                       const Control& control) const = 0;

  /// Radiance arriving at a point from each ghost sphere, all other emitters off: one cube map per sphere.
  /// When `sink` is set it receives every path; it is called from several threads, with `chunk` in
  /// [0, ghost_chunk_count): accumulate per chunk and reduce in chunk order to stay deterministic.
  using GhostSink = std::function<void(int chunk, const GhostPath&)>;
  static constexpr int ghost_chunk_count = 48;
  virtual std::vector<image::CubeMap> ghost_radiance(const CubeRequest& /*request*/,
                                                     std::span<const GhostSphere> /*ghosts*/,
                                                     const GhostSink& /*sink*/,
                                                     const Control& /*control*/) const {
    refuse("radiance source", "it cannot trace light of ghost spheres");
  }

  /// Irradiance at surface points. The point's own scattering counts as depth 1, so max_depth 1 gives direct
  /// light alone and `indirect` holds depths 2..max_depth. spp · passes paths per point.
  virtual std::vector<IrradianceEstimate> surface_irradiance(std::span<const SurfacePoint> /*points*/,
                                                             const PathParams& /*path*/,
                                                             const Control& /*control*/) const {
    refuse("radiance source", "it cannot trace irradiance at surface points");
  }

  /// Whether nothing blocks the open segment between two points.
  virtual bool visible(const vec3& a, const vec3& b) const = 0;

  /// Whether nothing at all is between them, glass neither: light on either side of a pane says nothing of
  /// the other.
  virtual bool joined(const vec3& a, const vec3& b) const { return visible(a, b); }

  /// Fraction of the directions around a point whose first hit is the back of a surface: near 1 inside a
  /// closed body, where a probe is of no use. 0 where the source cannot tell.
  virtual float backface_fraction(const vec3& /*position*/) const { return 0; }

  /// Rays traced so far by this object; 0 of one that does not count.
  virtual std::uint64_t rays_traced() const { return 0; }
};

/// Indirect light at surface points: all calls may come from several threads at once. Implemented by
/// probes::IrradianceLookup, probes::LightLookup, transport::GatherLight, transport::RecordedLight and the
/// light of every method in libs/methods.
class IndirectLight {
 public:
  virtual ~IndirectLight() = default;
  /// Indirect irradiance [W/m²].
  virtual vec3 irradiance(const SurfacePoint& at) const = 0;
  /// Names of the light groups whose direct light is in what this gives: a picture leaves theirs out.
  virtual std::vector<std::string> direct_groups() const { return {}; }
  /// Whether pictures show in mirrors what stands there, in this light, where they can; else glossy().
  virtual bool follows_mirrors() const { return true; }
  /// Names of those direct_groups() whose environment is not in glossy(): mirrors show it itself.
  virtual std::vector<std::string> mirrored_groups() const { return {}; }
  /// Radiance [W sr⁻¹ m⁻²] for a glossy lobe around the unit direction r; `roughness` is perceptual, 0..1.
  virtual vec3 glossy(const SurfacePoint& at, const vec3& r, float roughness) const = 0;
};

}  // namespace ssphh::rays
