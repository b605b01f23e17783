#pragma once
/// From lit surfels to the probes' functions.

#include <span>
#include <vector>

#include <ssphh/transport/network.h>
#include <ssphh/transport/projection.h>

namespace ssphh::transport {

/// S_i[k] = Σ_q w Y_k(ω_q) ρ_q/π · E(patch seen): reflected light of every probe. `irradiance` is E_direct +
/// E_indirect per patch.
void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::vector<sh::RadianceSh>& out);

/// The same of the probes [begin, end); `out` holds a function for each probe. `scratch` grows once.
void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::size_t begin, std::size_t end,
                       std::vector<float>& scratch, std::vector<sh::RadianceSh>& out);

/// The same of one probe.
void project_reflected(const TransportNetwork& network, const DirectionProjector& projector,
                       std::span<const Irradiance4> irradiance, std::size_t probe, sh::RadianceSh& out);

/// What one probe sees by way of panes.
std::span<const MirroredPatch> mirrored_of(const TransportNetwork& network, std::size_t probe);

/// Radiance of a patch that reflects the irradiance given.
vec3 radiance_of(const SeenPatch& patch, std::span<const Irradiance4> irradiance);

/// Where a probe looks for emitters: more directions than for reflected light, since small lamps are bright
/// and slip between few rays.
std::vector<vec3> emitter_directions();

/// Emitters that a probe sees directly, as posed, one function per light group: emissive surfaces, and what
/// `light` knows of emitters that are no surfaces. `directions` are those of `projector`. Rays are traced
/// only where an emitter may be met: none in a scene of point lights.
std::vector<sh::RadianceSh> project_emitted(const TransportNetwork& network,
                                            const rays::TransportSource& source,
                                            const DirectionProjector& projector,
                                            std::span<const vec3> directions, const vec3& position,
                                            const rays::DirectLight& light);

}  // namespace ssphh::transport
