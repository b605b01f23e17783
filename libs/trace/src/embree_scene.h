#pragma once
/// All instances of a posed scene as one Embree scene.

#include <cstdint>
#include <memory>
#include <vector>

#include <ssphh/scene/scene.h>
#include <ssphh/shading/surface.h>

#include "rays.h"
#include "triangle_records.h"

namespace ssphh::trace {

/// Instances are flattened to world space, each its own Embree geometry whose id is the instance's index:
/// fastest, and hits are exact there. Meshes used several times whose copies exceed `flatten_limit` triangles
/// in all are shared through Embree's instancing instead.
class EmbreeScene {
 public:
  static constexpr std::uint64_t default_flatten_limit = 4'000'000;

  /// Throws Error when memory is short. `only` chooses instances; empty: all.
  EmbreeScene(const scene::Scene& scene, const std::vector<mat4>& world,
              std::uint64_t flatten_limit = default_flatten_limit, const std::vector<bool>& only = {});
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Nearest hit. Surfaces with alpha let a ray pass with probability 1 − alpha, decided by a hash of
  /// `alpha_seed` and the triangle; with seed 0 those of alpha < ½ let every ray pass.
  bool intersect(const Ray& ray, std::uint64_t alpha_seed, RayTask& task, Hit& hit) const;
  bool occluded(const Ray& ray, std::uint64_t alpha_seed, RayTask& task) const;

  /// Shading inputs. `ray_origin` is where new rays start: on the side of `wo`, above the surface by more
  /// than the rounding error of `position`.
  shading::Surface surface(const Hit& hit, const vec3& wo, vec3& ray_origin) const;

  /// Coverage at a hit, 0..1.
  float alpha(const Hit& hit) const;
  /// Whether a ray along `direction` hit the back of a one-sided surface.
  bool is_back(const Hit& hit, const vec3& direction) const;
  bool has_alpha() const { return has_alpha_; }
  bool emissive(int instance) const { return parts_[static_cast<std::size_t>(instance)].emissive; }

 private:
  struct Part {
    const scene::Mesh* mesh = nullptr;
    int material = -1;
    bool emissive = false;
    bool instanced = false;
    mat4 world{1};
    mat3 normal_matrix{1};
    std::vector<vec3> vertices;  ///< world space; of instanced parts none, nor records
    TriangleRecords records;
  };
  struct Embree;

  void add_flat(int instance);
  void add_instanced(int instance);
  void check(const char* what) const;

  const scene::Scene& scene_;
  std::vector<Part> parts_;
  bool has_alpha_ = false;
  std::unique_ptr<Embree> embree_;
};

}  // namespace ssphh::trace
