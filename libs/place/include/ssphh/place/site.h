#pragma once
/// What a place sees: a fan of rays around it.

#include <limits>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::place {

inline constexpr int fan_size = 128;        ///< rays that judge a probe
inline constexpr int coarse_fan_size = 48;  ///< rays that compare grids

/// Distances in metres, infinite where there is nothing.
struct Site {
  float nearest = std::numeric_limits<float>::infinity();
  /// Harmonic mean of the distances seen (Ward, Rubinstein & Clear, A Ray Tracing Solution for Diffuse
  /// Interreflection, SIGGRAPH 1988): about how far the light is alike.
  float harmonic = std::numeric_limits<float>::infinity();
  float back = 0;          ///< share of the surfaces seen that show their backs
  float escaped = 0;       ///< share of the rays that meet nothing
  bool emitter = false;    ///< a shining surface is seen
  vec3 nearest_hit{0};     ///< place of the nearest surface, as a vector from here
  vec3 nearest_normal{0};  ///< of that surface, toward here
  float nearest_back = std::numeric_limits<float>::infinity();
  vec3 nearest_back_hit{0};  ///< of the surfaces seen from behind
};

/// Looks around from `position` in part 0 of the source. Throws Error for rays beside 1 to fan_size.
Site look_around(const rays::TransportSource& source, const vec3& position, int rays = fan_size);

/// Looks around from many places, on all threads.
std::vector<Site> look_around(const rays::TransportSource& source, std::span<const vec3> positions, int rays,
                              const Control& control);

/// What a place must keep to.
struct SiteRules {
  float clearance = 0.04f;
  float back_limit = 0.25f;
};

inline bool inside_body(const Site& site, const SiteRules& rules) {
  return site.back > rules.back_limit;
}
inline bool valid(const Site& site, const SiteRules& rules) {
  return !inside_body(site, rules) && site.nearest >= rules.clearance;
}

/// Share of backs above which a place counts as inside a body: a quarter, or more where cameras, lamps and
/// SPHLs see more backs themselves (sheets without thickness, surfaces wound the wrong way round). 1: the
/// scene's surfaces do not tell inside from outside.
float calibrated_back_limit(const rays::TransportSource& source, std::span<const vec3> interest);

/// Whether part 0 leaves the way between two places free.
bool sees(const rays::TransportSource& source, const vec3& a, const vec3& b);

}  // namespace ssphh::place
