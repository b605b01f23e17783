#pragma once
/// SPHLs that are lights: a sphere that emits a spherical function of direction, on surfels and on other
/// probes.

#include <span>
#include <vector>

#include <ssphh/sh/coefficients.h>
#include <ssphh/transport/network.h>

namespace ssphh::transport {

struct SphlEmitter {
  vec3 position{0};
  float radius = 0.1f;
  sh::RadianceSh leaving;  ///< radiance that leaves into each direction; empty: dark
};

/// Adds π (r/d)² cosθ L(ω_e) at every sample from which the way to the sphere's surface is free: exact for a
/// uniform sphere above the horizon, and for any function in the limit r ≪ d. Within the sphere d counts as
/// r. Returns the rays traced.
std::size_t add_emission(const TransportNetwork& network, const rays::TransportSource& source,
                         const SphlEmitter& emitter, std::span<vec3> samples);

/// Share of all directions that the sphere takes up, seen from a point: (1 − √(1 − (r/d)²)) / 2; 1 within it.
float sphere_share(const vec3& from, const SphlEmitter& emitter);

/// Adds the sphere as seen from a probe in free view of it: a disc of half-angle asin(r/d) with radiance
/// L(ω_e). From within it is all around.
void add_seen_emission(const vec3& probe, const SphlEmitter& emitter, sh::RadianceSh& out);

/// Whether the way from a point to the sphere's surface is free.
bool sees(const TransportNetwork& network, const rays::TransportSource& source, const vec3& from,
          const SphlEmitter& emitter);

/// Share of the sphere's disc that each point sees, by 16 rays; 1 within the sphere.
std::vector<float> visible_shares(const TransportNetwork& network, const rays::TransportSource& source,
                                  std::span<const vec3> from, const SphlEmitter& emitter);

/// Whether nothing static or moving blocks the segment, as the network is posed.
bool sees(const TransportNetwork& network, const rays::TransportSource& source, const vec3& a, const vec3& b);

}  // namespace ssphh::transport
