#pragma once
/// From lit surfels to the probes' functions.

#include <span>
#include <vector>

#include <ssphh/gi/transport/network.h>
#include <ssphh/gi/transport/projection.h>

namespace ssphh::gi {

/// S_i[k] = Σ_q w Y_k(ω_q) ρ_q/π · E(surfel seen): reflected light of every probe. `irradiance` is E_direct +
/// E_indirect per surfel.
void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::vector<sh::RadianceSh>& out);

/// Emitters of one group that probe i sees directly: emissive surfaces, and what `light` knows of emitters
/// that are no surfaces.
sh::RadianceSh project_emitted(const TransportNetwork& network, const DirectionProjector& projector,
                               std::size_t probe, int group, const scene::DirectLight& light);

}  // namespace ssphh::gi
