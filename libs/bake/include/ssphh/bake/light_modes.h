#pragma once
/// What light modes mean to a set that has been baked (docs/light-modes.md).

#include <span>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/scene.h>

namespace ssphh::bake {

/// Indices of the groups that are baked: transport::GatherParams::baked.
std::vector<int> baked_indices(std::span<const scene::LightMode> modes);

/// Of the set's light groups, in their order.
std::vector<scene::LightMode> light_modes(const probes::ProbeSet& set);

/// Gives the set's light groups, which are those of the source in its order, their modes. What the emitters
/// of baked groups send straight to each probe is found anew by sampling them: rays in all directions would
/// meet small ones by chance, and lamps that are points never. Throws Error for another number of groups, and
/// where a group is baked and the set has no surface records to keep its light in; Cancelled.
void set_light_modes(const rays::TransportSource& source, probes::ProbeSet& set,
                     std::span<const scene::LightMode> modes, const Control& control = {});

/// In which groups the set holds direct light and the scene asks for another mode, or the other way round:
/// "light group "sky" as realtime, asked for as baked; ..."; empty: none. Realtime and mixed groups hold the
/// same.
std::string mode_difference(const probes::ProbeSet& set, const scene::Scene& scene);

/// A line for each baked group with lamps whose shadows are sharp, which records blur; empty: none.
std::vector<std::string> blurred_shadows(const scene::Scene& scene);

}  // namespace ssphh::bake
