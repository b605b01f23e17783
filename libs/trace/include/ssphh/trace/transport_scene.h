#pragma once
/// Answers the questions of transport between probes with Embree.

#include <memory>

#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/scene.h>
#include <ssphh/trace/scene_geometry.h>

namespace ssphh::trace {

struct TransportOptions {
  /// Shadow rays per point and light with an extent; where the first quarter of them agrees, no more.
  int light_samples = 16;
  int environment_samples = 64;  ///< shadow rays per point to the environment
  /// How far points handed in may lie below their surface (means, compressed positions), relative to the
  /// size of the scene: shadow rays start so much above them, or more where float coordinates need it.
  float surface_tolerance = 5e-5f;
};

/// A part is what hangs together on one animated node: the instances for which it is the nearest animated
/// ancestor or itself, named after it, in its coordinates. Parts stand in the order of their nodes.
///
/// Surfaces with partial coverage are either there (alpha ≥ ½) or not; sample_part leaves out the points
/// where they are not. Unlit surfaces show their emission to rays but are no light: DirectLight does not know
/// them. Random numbers depend on the bits of a point's position alone, so no answer depends on its
/// neighbours in a batch. Calls may come from several threads; large batches use all threads themselves.
class TransportScene final : public rays::TransportSource {
 public:
  /// Keeps a reference to the scene. Throws Error where the geometry was built for a scene with other
  /// surfaces, or for options out of range.
  TransportScene(SharedGeometry geometry, const scene::Scene& scene, const TransportOptions& options = {});
  TransportScene(SharedGeometry, const scene::Scene&&,
                 const TransportOptions& = {}) = delete;  // it would be gone
  /// Builds the geometry as well.
  explicit TransportScene(const scene::Scene& scene, const TransportOptions& options = {});
  explicit TransportScene(const scene::Scene&&, const TransportOptions& = {}) = delete;  // it would be gone
  ~TransportScene() override;

  int part_count() const override;
  const std::string& part_name(int part) const override;
  scene::Bounds part_bounds(int part) const override;
  float duration() const override;
  mat4 part_pose(int part, float time) const override;
  std::vector<rays::PartPoint> sample_part(int part, double points_per_square_metre) const override;
  float surface_gap() const override;

  void intersect(int part, std::span<const rays::RayQuery> rays, std::span<rays::RayHit> hits) const override;
  std::vector<rays::MirroredRay> mirrored(int part, std::span<const rays::RayQuery> rays,
                                          std::span<const rays::RayHit> hits) const override;
  void occluded(int part, std::span<const rays::RayQuery> rays,
                std::span<std::uint8_t> blocked) const override;
  bool joined(int part, const rays::RayQuery& segment) const override;

  const std::vector<std::string>& light_groups() const override;
  std::vector<scene::LightState> lights(float time) const override;
  const std::vector<std::string>& light_names() const override;
  int light_group_of(int light) const override;
  bool group_emits_from(int group, int part) const override;
  int environment_group() const override;
  /// What it returns may outlive this object, but not the scene.
  std::unique_ptr<rays::DirectLight> direct_light(
      std::span<const scene::LightState> lights, std::span<const mat4> poses,
      const scene::EnvironmentState& environment = {}) const override;
  /// Without allocation, but for emissive instances that move and an environment that changes.
  void renew_direct_light(std::unique_ptr<rays::DirectLight>& light,
                          std::span<const scene::LightState> lights, std::span<const mat4> poses,
                          const scene::EnvironmentState& environment) const override;
  std::unique_ptr<rays::RadianceSource> path_tracing(const scene::LightingState& state) const override;

  std::uint64_t rays_traced() const override;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace ssphh::trace
