#pragma once
/// Moves a place that is no good to a near one that is.

#include <functional>
#include <optional>

#include <ssphh/place/site.h>

namespace ssphh::place {

struct Relocated {
  vec3 position;
  Site site;
};

/// Out of a body through its nearest back, or off the nearest surface, in a few steps; at most `limit` metres
/// away. None when that leads to no valid place.
std::optional<Relocated> relocate(const rays::TransportSource& source, const vec3& position, const Site& site,
                                  const SiteRules& rules, float limit);

/// The nearest valid place among steps along the axes and diagonals, at most `limit` metres away, that `free`
/// accepts.
std::optional<Relocated> sidestep(const rays::TransportSource& source, const vec3& position,
                                  const SiteRules& rules, float limit,
                                  const std::function<bool(const vec3&)>& free);

}  // namespace ssphh::place
