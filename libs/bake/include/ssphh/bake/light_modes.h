#pragma once
/// What light modes mean to a set that has been baked (docs/light-modes.md).

#include <span>
#include <string>
#include <vector>

#include <ssphh/bake/light_scope.h>
#include <ssphh/core/control.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/scene.h>

namespace ssphh::bake {

/// Indices of the groups whose direct light is kept: transport::GatherParams::baked.
std::vector<int> baked_indices(std::span<const scene::LightMode> modes);

/// The modes of the scene's light groups, in their order: what it asks for, else with `records` what is usual
/// for them. Without, nothing is kept unasked.
std::vector<scene::LightMode> light_modes(const scene::Scene& scene, bool records);

/// The modes of the set's light groups, in their order.
std::vector<scene::LightMode> light_modes(const probes::ProbeSet& set);

/// Gives the set's light groups, which are those of the source in its order, their modes. What the emitters
/// of baked groups send straight to each probe in `scope` is found anew by sampling them: rays in all
/// directions would meet small ones by chance, and lamps that are points never. Throws Error for another
/// number of groups, and where direct light is to be kept and the set has no surface records to keep it in;
/// Cancelled.
void set_light_modes(const rays::TransportSource& source, probes::ProbeSet& set,
                     std::span<const scene::LightMode> modes, const Control& control = {},
                     const LightScope& scope = {});

/// Takes the modes that the scene asks for: direct light that the set keeps may be left unused. See
/// mode_difference().
void adopt_modes(probes::ProbeSet& set, const scene::Scene& scene);

/// Names the groups of which the scene asks for direct light that the set does not keep: "light group "sky"
/// as realtime, asked for as baked; ..."; empty: none.
std::string mode_difference(const probes::ProbeSet& set, const scene::Scene& scene);

/// A line for each baked group with lamps whose shadows are sharp, which records blur; empty: none.
std::vector<std::string> blurred_shadows(const scene::Scene& scene);

}  // namespace ssphh::bake
