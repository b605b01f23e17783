#pragma once
/// Indirect light of one lamp alone, wherever it is moved to.

#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/held.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::pipeline {

/// Lights points of surfaces as a baked set would, had it been baked with the lamp elsewhere: between surfels
/// as fine as the set's, kept in its records and places, in the pose of its time.
class LampLight {
 public:
  /// Keeps references to `source` and to `sight`, by which points see records. Throws Error as
  /// transport::RelightSession does; Cancelled when asked to stop.
  LampLight(const rays::TransportSource& source, const rays::RadianceSource& sight,
            const probes::ProbeSet& set, std::vector<rays::SurfacePoint> points, const Control& control = {});
  LampLight(const rays::TransportSource&&, const rays::RadianceSource&, const probes::ProbeSet&,
            std::vector<rays::SurfacePoint>, const Control& = {}) = delete;
  ~LampLight();
  LampLight(LampLight&&) noexcept;
  LampLight& operator=(LampLight&&) noexcept;

  /// Indirect irradiance [W/m²] at each point while this light of the scene's list, at full strength, stands
  /// at `place` [m], turned as it is, and everything else is dark: until the next call. Throws Error for a
  /// light that there is not and a place that is not finite; Cancelled.
  std::span<const vec3> at(std::size_t light, const vec3& place, const Control& control = {});

 private:
  struct Data;
  Held<Data> data_;
};

}  // namespace ssphh::pipeline
