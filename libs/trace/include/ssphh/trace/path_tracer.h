#pragma once
/// Unidirectional path tracer over Embree: next-event estimation with MIS, light groups, progressive passes.
/// The same bits for any number of threads.

#include <memory>

#include <ssphh/core/held.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene/scene.h>
#include <ssphh/trace/render_state.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::trace {

/// A scene at one time, ready for rays. Keeps a reference to the scene, or the scene where it is shared.
class PathTracer final : public rays::RadianceSource {
 public:
  /// Throws Error where the geometry was built for a scene with other surfaces.
  PathTracer(SharedGeometry geometry, const scene::Scene& scene, float time = 0);
  PathTracer(SharedGeometry, const scene::Scene&&, float = 0) = delete;  // it would be gone
  PathTracer(SharedGeometry geometry, std::shared_ptr<const scene::Scene> scene, float time = 0);
  /// Builds the geometry as well.
  explicit PathTracer(const scene::Scene& scene, float time = 0);
  explicit PathTracer(const scene::Scene&&, float = 0) = delete;  // it would be gone
  ~PathTracer() override;
  PathTracer(PathTracer&&) noexcept;
  PathTracer& operator=(PathTracer&&) noexcept;

  const std::vector<std::string>& light_groups() const override;
  std::vector<rays::GroupRadiance> incident_radiance(const rays::CubeRequest& request,
                                                     const Control& control) const override;
  /// A ray that meets a ghost sphere before a surface, or starts inside one, sees its radiance. The caller
  /// leaves out the probe's own sphere.
  std::vector<image::CubeMap> ghost_radiance(const rays::CubeRequest& request,
                                             std::span<const rays::GhostSphere> ghosts, const GhostSink& sink,
                                             const Control& control) const override;
  /// Direct light by next-event estimation and scattered rays combined. Up to 16 batches of paths with
  /// sequences of their own give the variance, which one path alone leaves infinite. Rays start above points
  /// that lie up to 5e-5 of the scene's size below their surface.
  std::vector<rays::IrradianceEstimate> surface_irradiance(std::span<const rays::SurfacePoint> points,
                                                           const rays::PathParams& path,
                                                           const Control& control) const override;
  /// From now on surface_irradiance() counts the direct light of these light groups as indirect: the truth
  /// for lookups that hold it (rays::IndirectLight::direct_groups).
  void count_as_indirect(std::span<const std::string> groups);
  bool visible(const vec3& a, const vec3& b) const override;
  bool joined(const vec3& a, const vec3& b) const override;
  /// From 128 rays; a miss and a double-sided material count as front.
  float backface_fraction(const vec3& position) const override;
  std::uint64_t rays_traced() const override;

  /// Adds passes to `state` until it holds params.path.passes. After a Cancelled, `state` holds the passes
  /// finished so far and can be continued. `see` is told of each pass.
  void render(const RenderParams& params, RenderState& state, const Control& control = {},
              const SeePass& see = {}) const;

  /// Path traced direct light, indirect light looked up from probes at the first hit.
  void render_with(const rays::IndirectLight& indirect, const RenderParams& params, RenderState& state,
                   const Control& control = {}, const SeePass& see = {}) const;

 private:
  struct Data;
  Held<Data> data_;
};

}  // namespace ssphh::trace
