#pragma once
/// Light of one bake at another's points of surfaces, so that both can be swapped.

#include <ssphh/cook/cook.h>

namespace ssphh::cook {

/// The set with the points of `places`: light of its records is looked up there, and fitted weights are those
/// of `places`. Throws Error unless both have the same probes and kinds of points, and the set's points are
/// whole.
probes::ProbeSet at_places_of(const probes::ProbeSet& places, probes::ProbeSet set,
                              const probes::SeesProbe& sees, const Control& control);

}  // namespace ssphh::cook
