#pragma once
/// Warnings about probes and networks that cannot light what they should.

#include <ssphh/transport/relight_session.h>

namespace ssphh::app {

/// Warns of places inside bodies, and of those that a moving part passes if parts are to move.
void warn_about_places(const std::vector<transport::ProbePlace>& places, const rays::TransportSource& source,
                       const std::vector<vec3>& interest, bool parts_move, const Control& control);

/// Warns of probes that see nothing, and of a network in which no surface sees another.
void warn_about_network(const transport::RelightSession& session);

}  // namespace ssphh::app
