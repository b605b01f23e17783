#pragma once
/// How paths find emitters that flat sheets of glass mirror: straight from a vertex's mirror image through
/// the sheet. By chance alone, one of many ten thousand finds a sun's.

#include "panes.h"
#include "posed_geometry.h"

namespace ssphh::trace {

class PaneMirrors {
 public:
  /// Each vertex asks all of them: the largest are kept, the others are left to scattered rays.
  static constexpr std::size_t most_panes = 256;

  /// Of those panes that mirror in one direction wherever they are met.
  PaneMirrors(std::vector<Pane> panes, const scene::Scene& scene);
  bool any() const { return !panes_.empty(); }

  struct Choice {
    const Pane* pane = nullptr;  ///< null: none can be seen
    float chance = 0;            ///< of this choice
  };
  /// A pane that a surface may see, those that look large more often than others.
  Choice choose(const vec3& position, const vec3& normal, float u) const;
  /// With which choose() takes the pane.
  float chance(const vec3& position, const vec3& normal, const Pane& pane) const;
  /// The pane that was hit; null: what was hit is none.
  const Pane* at(const Hit& hit) const;

 private:
  std::vector<Pane> panes_;
};

/// What a sheet mirrors of a ray that meets it, 0..1 and times its share of the surface; 0: it is no such
/// glass there as the ray passes.
vec3 mirrored_by(const shading::Surface& surface, const vec3& direction, const Passage& passage);

/// Share of a sample's light that arrives at `position` by way of a pane, which lies in direction
/// `toward.wi`; `toward.distance` is the whole way. `start`: where rays leave the position. `mirrored`, if
/// not null, becomes what the pane mirrors.
vec3 mirrored_share(const PosedGeometry& scene, const Pane& pane, const vec3& start, const vec3& position,
                    const shading::LightSample& toward, const Passage& passage, RayTask& task,
                    vec3* mirrored = nullptr);

}  // namespace ssphh::trace
