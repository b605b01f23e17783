#pragma once
/// The acceleration structures of a scene, for all who trace rays in it.

#include <cstdint>
#include <memory>

#include <ssphh/scene/scene.h>

namespace ssphh::trace {

/// One structure for everything that never moves and one for each moving part, in the part's own frame: they
/// serve every pose. Built once, never changed, shared by path tracers and transport:
///
///   const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
///   const trace::PathTracer tracer(geometry, scene, time);
///   const trace::TransportScene source(geometry, scene);
///
/// Both also take scenes whose lights, cameras and material values differ from those of the scene it was
/// built for, as with_lighting() makes them.
class SceneGeometry {
 public:
  static constexpr std::uint64_t default_flatten_limit = 4'000'000;

  /// Keeps a reference to the scene. Instances are flattened to the frame of their part, which is fastest;
  /// meshes used several times whose copies exceed `flatten_limit` triangles in all are shared instead.
  /// Throws Error when the geometry does not fit into memory.
  explicit SceneGeometry(const scene::Scene& scene, std::uint64_t flatten_limit = default_flatten_limit);
  explicit SceneGeometry(const scene::Scene&&, std::uint64_t = 0) = delete;  // it would be gone
  ~SceneGeometry();
  SceneGeometry(const SceneGeometry&) = delete;
  SceneGeometry& operator=(const SceneGeometry&) = delete;

  /// How many have been built in this process so far.
  static std::uint64_t builds() noexcept;

  struct Data;
  const Data& data() const { return *data_; }  ///< for this module

 private:
  std::unique_ptr<const Data> data_;
};

using SharedGeometry = std::shared_ptr<const SceneGeometry>;

/// A geometry that keeps its scene alive.
SharedGeometry geometry_of(std::shared_ptr<const scene::Scene> scene);

}  // namespace ssphh::trace
