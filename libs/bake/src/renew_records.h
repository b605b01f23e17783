#pragma once
/// Surface records of which a part is found anew.

#include <ssphh/bake/light_scope.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::bake {

/// Of each point whether the nearest of the set's probes is in the scope: 1, else 0.
std::vector<std::uint8_t> near_probes(std::span<const rays::SurfacePoint> points, const probes::ProbeSet& set,
                                      const LightScope& scope);

/// Finds the records of the session's light that are nearest to the scope's probes: places and light; the set
/// keeps the others. Of some light groups alone, or where the set's other groups are to keep theirs, records
/// stay where they stand and the light of these groups is gathered there. The session has had its first
/// update(). Leaves what merge_groups derives as it is.
void renew_records(transport::RelightSession& session, probes::ProbeSet& set,
                   const transport::GatherParams& params, const LightScope& scope, const Control& control);

}  // namespace ssphh::bake
