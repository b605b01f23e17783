#pragma once
/// Options that the commands around probe files share.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/scene.h>

#include "options/command_line.h"

namespace ssphh::app {

/// Options whose values must be named as a probe file is: anything else is wrong usage, before any work.
Option add_probe_file(const Command& command, const std::string& names, std::string& file,
                      const std::string& help);
Option add_probe_files(const Command& command, const std::string& names, std::vector<std::string>& files,
                       const std::string& help);

Option add_force_option(Command command, bool& force);

/// What tells the scene from the one in which the set was baked: name, content, light groups, modes that it
/// asks for and by which the set would hold other light, and where something moves the time, if one is given.
/// Empty: nothing.
std::string scene_difference(const probes::ProbeSet& set, const scene::Scene& scene,
                             const std::vector<std::string>& light_groups, std::optional<float> time);

/// Throws an Error that names the differences; a warning with `force`.
void require_same_scene(const std::string& file, const probes::ProbeSet& set, const scene::Scene& scene,
                        const std::vector<std::string>& light_groups, std::optional<float> time, bool force);

/// Reads a probe file and holds its set against the scene, as require_same_scene() does.
probes::ProbeSet read_probes_of(const scene::Scene& scene, const std::string& file, std::optional<float> time,
                                bool force);

/// Places of the cameras and probes (without probes: also of lamps and SPHLs; without any of these: where
/// study::default_view() looks from): what they can reach is what counts. `source` is of the scene.
std::vector<vec3> viewpoints(const scene::Scene& scene, const rays::TransportSource& source,
                             std::span<const probes::ProbeSet> sets, float time);

/// --lookup, --weights of the lookup `irradiance` (none: the library chooses) and --light.
Option add_lookup_option(Command command, probes::LookupMethod& method);
Option add_weights_option(Command command, std::optional<probes::WeightMethod>& weights);
Option add_layer_option(Command command, probes::ProbeLayer& layer);

/// --truth-spp, which is returned, and --max-depth of paths that tell what light there really is.
Option add_truth_path_options(const Command& command, int& spp, int& max_depth);

/// What the choice means for the set in `file`. Throws Error for `fitted` and `surface` with a set that
/// has none.
probes::LookupParams lookup_params(const std::string& file, const probes::ProbeSet& set,
                                   const probes::LookupSpec& spec);

}  // namespace ssphh::app
