#pragma once
/// How far apart points on surfaces are: what lookups between them measure distances in.

#include <span>
#include <vector>

#include <ssphh/rays/transport_source.h>

namespace ssphh::probes {

/// Of each point the mean distance [m] of its four nearest neighbours that face about the same way and lie in
/// its plane, of the 48 that are near; at most six tenths of the distance of the twelfth of any, which on an
/// even plane is more: a neighbour beyond a room's clutter tells nothing. On a strip between other surfaces,
/// whose points are no worse for those, not less than eight tenths of the distance of the second neighbour
/// along it, up to four times that. No less than a quarter of what all but a fiftieth of the points have. 0
/// for fewer than two places.
std::vector<float> surface_spacings(std::span<const rays::SurfacePoint> points);

}  // namespace ssphh::probes
