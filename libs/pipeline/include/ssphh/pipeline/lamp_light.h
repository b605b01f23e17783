#pragma once
/// Indirect light of one lamp alone, wherever it is moved to.

#include <ssphh/core/control.h>
#include <ssphh/core/held.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::pipeline {

/// Lights surfaces as a baked set would, had it been baked with the lamp elsewhere: between surfels as fine
/// as the set's, kept in its records and places, in the pose of its time.
class LampLight {
 public:
  /// Keeps references to `source` and to `sight`, by which lookups see their records. Throws Error as
  /// transport::RelightSession does; Cancelled when asked to stop.
  LampLight(const rays::TransportSource& source, const rays::RadianceSource& sight,
            const probes::ProbeSet& set, const Control& control = {});
  LampLight(const rays::TransportSource&&, const rays::RadianceSource&, const probes::ProbeSet&,
            const Control& = {}) = delete;
  ~LampLight();
  LampLight(LampLight&&) noexcept;
  LampLight& operator=(LampLight&&) noexcept;

  /// Indirect light while this light of the scene's list, at full strength, stands at `place` [m], turned as
  /// it is, and everything else is dark: until the next call. Throws Error for a light that there is not and
  /// a place that is not finite; Cancelled.
  const rays::IndirectLight& at(std::size_t light, const vec3& place, const Control& control = {});

 private:
  struct Data;
  Held<Data> data_;
};

}  // namespace ssphh::pipeline
