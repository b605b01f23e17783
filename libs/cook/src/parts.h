#pragma once
/// The parts of a cooked file, each from what it is made of.

#include <ssphh/cook/cook.h>
#include <ssphh/probes/surface_lists.h>
#include <ssphh/rays/posed_world.h>

#include "sections.h"

namespace ssphh::cook {

/// Places of the probes, the lists of those that may light each cell, and what they see; without a world they
/// see all.
void add_probes(Sections& out, const probes::ProbeSet& set, const rays::PosedWorld* world,
                const CookParams& params, const Control& control);

/// Points of surfaces and their lists.
void add_points(Sections& out, const probes::SurfaceLists& lists);

}  // namespace ssphh::cook
