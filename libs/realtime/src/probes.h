#pragma once
/// SPHLs in OpenGL's memory: places, light, the cells that tell which stand around a point, and their shadow
/// maps.

#include <optional>
#include <span>
#include <vector>

#include <ssphh/probes/candidate_grid.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/realtime/renderer.h>

#include "fitted_light.h"
#include "probe_tiles.h"
#include "shadow_maps.h"
#include "tile_atlas.h"

namespace ssphh::realtime {

class Probes {
 public:
  Probes();
  /// As probes::IrradianceLookup reads a set. Throws Error as that does. `glossy`: something reflects
  /// otherwise than Lambert's law says, so radiance is kept by roughness.
  Probes(const probes::ProbeSet& set, const probes::LookupParams& params, const RendererParams& renderer,
         const scene::Bounds& bounds, bool glossy, FrameCounters& counters);

  int count() const { return static_cast<int>(places_.size()); }
  const vec3& position(int probe) const { return places_[probe]; }
  float radius(int probe) const { return radii_[probe]; }
  float spacing() const { return spacing_; }
  const probes::CandidateGrid& grid() const { return grid_; }
  const MapAtlas& maps() const { return maps_; }
  float near_plane() const { return near_; }

  void set_light(std::span<const int> probes, std::span<const sh::RadianceSh> light, FrameCounters& counters);
  /// Of each probe what more lights things that move; empty: nothing. Of a set whose records keep direct
  /// light.
  void set_light_of_moving(std::span<const sh::RadianceSh> light, FrameCounters& counters);
  /// Whether it does.
  void use_light_of_moving(bool use) { uses_light_of_moving_ = use; }
  /// Points with weights of their own; empty: none. Throws Error for points that name a probe which there is
  /// not.
  void set_fitted(const probes::FittedSurfaces& fitted, FrameCounters& counters);
  /// Records of surfaces, dark until set_record_light; empty: none. They and fitted points replace each
  /// other.
  void set_records(const probes::SurfaceLists& lists, FrameCounters& counters);
  /// Throws Error unless there is one light for each record.
  void set_record_light(std::span<const probes::RecordLight> light, FrameCounters& counters);
  bool has_fitted() const { return fitted_.has_value(); }
  bool has_records() const { return surface_ && !fitted_; }
  /// Makes the tiles of radiance, which only glossy surfaces and SPHLs as lights need, unless they are there.
  void want_radiance(FrameCounters& counters);
  /// The probe's shadow map shall hold what is beyond those that look it up, too: it is a light.
  void see_all(int probe);
  void invalidate(const std::vector<scene::Bounds>& moved) { maps_.invalidate(moved); }
  int update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most, int& waiting,
                  FrameCounters& counters);
  /// For a program that looks probes up.
  void bind_lookup(gl::Program& program) const;
  /// Shadow maps, and which probes stand where.
  void bind_sight() const;
  std::size_t bytes() const;

 private:
  std::vector<vec3> places_;
  std::vector<float> radii_;
  int radiance_degree_ = 0;
  float spacing_ = 1, near_ = 1e-3f;
  std::vector<sh::RadianceSh> light_;
  bool keeps_direct_ = false;                                        ///< there is room for the next
  bool has_light_of_moving_ = false, uses_light_of_moving_ = false;  ///< in tiles after the probes' own
  probes::CandidateGrid grid_;
  MapAtlas maps_;
  IrradianceTiles irradiance_tiles_;
  std::optional<RadianceTiles> radiance_tiles_;  ///< none: no one has wanted them
  TileAtlas irradiance_, radiance_;
  void place_maps(int probe, float reach);
  std::vector<int> all_probes() const;
  void upload_irradiance(std::span<const int> probes, FrameCounters& counters);
  void upload_radiance(std::span<const int> probes, FrameCounters& counters);

  std::vector<vec3> irradiance_functions_;  ///< coefficients, probe after probe
  std::optional<SurfaceLight> surface_;     ///< of fitted points or records
  std::optional<FittedLight> fitted_;
  int levels_ = 1;                       ///< roughnesses of which radiance is kept
  std::vector<unsigned char> sees_all_;  ///< of each probe; empty: none does
  std::vector<vec4> texels_;             ///< of the probes that change, while they are made
  gl::Texture cells_;
};

}  // namespace ssphh::realtime
