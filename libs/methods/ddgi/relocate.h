#pragma once
/// Probes moved out of walls, and those that cannot be put to sleep.

#include <ssphh/rays/posed_world.h>

#include "field.h"

namespace ssphh::methods::ddgi {

/// A few steps for every probe, by rays in fixed directions: out through the nearest back of a surface, away
/// from fronts nearer than a tenth of the least spacing, or back toward its place on the grid; never farther
/// than 45 % of the spacing from it. Then a quarter of backs among what its rays meet tells that a probe
/// stands inside of a body: it is put to sleep. Marks in `fresh` the probes that wake up. Returns how many
/// rays were traced.
std::size_t relocate(DdgiField& field, const rays::PosedWorld& surfaces, int steps, bool move,
                     std::span<std::uint8_t> fresh);

}  // namespace ssphh::methods::ddgi
