#pragma once
/// What a grid of probes has to cover.

#include <ssphh/methods/method.h>

#include "grid.h"

namespace ssphh::methods::ddgi {

/// A grid (make_grid) over all surfaces in reach at the first, middle and last pose (a door may uncover more
/// than is open at first) and over the air before them, as far as one spacing: a surface that faces
/// outward needs a probe beyond it.
ProbeGrid grid_in_reach(const MethodScene& scene, float spacing, int probes, int most,
                        const Control& control);

}  // namespace ssphh::methods::ddgi
