#pragma once
/// The light of a RelightSession as probe sets: one group for lookups while it changes, or group by group as
/// a bake stores it.

#include <string>
#include <vector>

#include <ssphh/probes/probe_set.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::transport {

/// The places with their reflected light as one group, as lookups want it. Throws Error when there is not one
/// function of one degree for each place, as before a session's first update().
probes::ProbeSet lookup_set(const std::vector<scene::ProbePlace>& places,
                            const std::vector<sh::RadianceSh>& reflected);

/// The same of a session, with its records where it keeps any: reflected light as the first group, and beside
/// it those whose direct light the records keep, `diffuse` as long as it holds and `realtime` else.
probes::ProbeSet lookup_set(const RelightSession& session);

/// Brings a set that lookup_set made of this session up to date with the last update(). Does not allocate.
/// Throws Error for other sets.
void refresh(probes::ProbeSet& set, const RelightSession& session);

/// Gives every probe the light of each of the set's groups, [group][probe], as a bake stores it: emitted
/// light that is dark is left out.
void store_groups(probes::ProbeSet& set, std::vector<std::vector<sh::RadianceSh>> reflected,
                  std::vector<std::vector<sh::RadianceSh>> emitted);

/// The session's light as a bake would write it: groups apart and unscaled, the factors of its state beside
/// them. `groups` are their names. Throws Cancelled when asked to stop.
probes::ProbeSet baked_set(const RelightSession& session, const std::vector<std::string>& groups,
                           probes::GeneratorInfo generator, const Control& control = {});

}  // namespace ssphh::transport
