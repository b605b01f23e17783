#pragma once
/// SPHLs in OpenGL's memory: places, light, the cells that tell which stand around a point, and their shadow
/// maps.

#include <span>
#include <vector>

#include <ssphh/gi/lookup.h>
#include <ssphh/gi/probe_set.h>
#include <ssphh/realtime/renderer.h>

#include "probe_grid.h"
#include "shadow_maps.h"

namespace ssphh::realtime {

class Probes {
 public:
  Probes();
  /// As gi::IrradianceLookup reads a set. Throws Error as that does.
  Probes(const gi::ProbeSet& set, const gi::LookupParams& params, const RendererParams& renderer,
         const scene::Bounds& bounds, FrameCounters& counters);

  int count() const { return static_cast<int>(places_.size()); }
  const vec3& position(int probe) const { return places_[static_cast<std::size_t>(probe)]; }
  int irradiance_degree() const { return irradiance_degree_; }
  int radiance_degree() const { return radiance_degree_; }
  float spacing() const { return spacing_; }
  const ProbeGrid& grid() const { return grid_; }
  const MapAtlas& maps() const { return maps_; }
  float near_plane() const { return near_; }

  void set_light(std::span<const int> probes, std::span<const sh::RadianceSh> light, FrameCounters& counters);
  void set_emission(int probe, const sh::RadianceSh& leaving, FrameCounters& counters);
  void invalidate(const std::vector<scene::Bounds>& moved) { maps_.invalidate(moved); }
  int update_maps(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most, int& waiting,
                  FrameCounters& counters);
  void bind() const;
  std::size_t bytes() const;

 private:
  std::vector<vec3> places_;
  int irradiance_degree_ = 0, radiance_degree_ = 0;
  bool dering_ = true;
  float spacing_ = 1, near_ = 1e-3f;
  ProbeGrid grid_;
  MapAtlas maps_;
  std::vector<float> row_;  ///< of one probe, while it is made
  gl::Buffer place_buffer_, irradiance_, radiance_, grid_buffer_, emission_;
};

}  // namespace ssphh::realtime
