#pragma once
/// Options that the commands around probe files share.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/pipeline/scene_probes.h>
#include <ssphh/probes/probe_file.h>

#include "options/command_line.h"

namespace ssphh::app {

/// Options whose values must be named as a probe file is: anything else is wrong usage, before any work.
Option add_probe_file(const Command& command, const std::string& names, std::string& file,
                      const std::string& help);
/// The same of one to write, which is no folder of tiles.
Option add_probe_output(const Command& command, const std::string& names, std::string& file,
                        const std::string& help);
Option add_probe_files(const Command& command, const std::string& names, std::vector<std::string>& files,
                       const std::string& help);

/// A probe file or keys, as probes::read_probe_keys() has them; the second: whose light is blended at --time.
Option add_probe_keys(const Command& command, const std::string& names, std::string& files,
                      const std::string& help);
Option add_keyed_probes(const Command& command, const std::string& names, std::string& files,
                        const std::string& help);

Option add_force_option(Command command, bool& force);

using pipeline::lookup_params;
using pipeline::read_probes_of;
using pipeline::require_same_scene;
using pipeline::scene_difference;
using pipeline::viewpoints;

/// --lookup, --weights of the lookup `irradiance` (none: the library chooses) and --light.
Option add_lookup_option(Command command, probes::LookupMethod& method);
Option add_weights_option(Command command, std::optional<probes::WeightMethod>& weights);
Option add_layer_option(Command command, probes::ProbeLayer& layer);

/// --truth-spp, which is returned, and --max-depth of paths that tell what light there really is.
Option add_truth_path_options(const Command& command, int& spp, int& max_depth);

}  // namespace ssphh::app
