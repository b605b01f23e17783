#pragma once
/// The light that a set's own lookup gives in free space, where no surface is.

#include <ssphh/probes/lookup.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::probe_export {

struct LightAt {
  /// Incident radiance of degree 2 whose irradiance is the lookup's, projected: E[l,m] / A_l.
  sh::RadianceSh light;
  bool seen = false;  ///< by a probe; else the light is a guess, and may be that of another room
};

class FreeLight {
 public:
  /// `light`: only what surfaces reflected (and of baked groups all), or what emitters send straight, too.
  /// The source's parts block sight in the pose of the set's bake; it must outlive this, as `set` need not.
  /// Throws Error as probes::surface_light does.
  FreeLight(const probes::ProbeSet& set, const rays::TransportSource& source, probes::ProbeLight light);
  FreeLight(const probes::ProbeSet&, const rays::TransportSource&&, probes::ProbeLight) = delete;

  /// Light from all directions: the lookup is asked for the irradiance of 28 normals, and its light projected
  /// to degree 2 (exact where it is of degree 4, as a blend of probes is). Records and fitted weights belong
  /// to surfaces, and are not asked. Safe to call from several threads.
  LightAt at(const vec3& place) const;
  /// Irradiance [W/m²] of one normal. As LightAt::seen, `seen` tells whether to believe it.
  vec3 irradiance(const vec3& place, const vec3& normal, bool& seen) const;

  const rays::PosedWorld& world() const { return world_; }

 private:
  rays::PosedWorld world_;
  std::unique_ptr<probes::IrradianceLookup> lookup_;  ///< whose own weights are those of surfaces
  std::unique_ptr<probes::VisibleWeights> weights_;   ///< for the sight of each place
};

}  // namespace ssphh::probe_export
