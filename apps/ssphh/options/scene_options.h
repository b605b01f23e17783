#pragma once
/// The options of every command that reads a scene.

#include <string>

#include <ssphh/pipeline/scene_options.h>

#include "options/command_line.h"

namespace ssphh::app {

using pipeline::SceneOptions;

/// Adds the positional SCENE (or the option that `source` names) and --overlay, --unit, --lambert,
/// --environment, --sky and so on; --time where a pose matters.
void add_scene_options(Command command, SceneOptions& options, bool posed = true,
                       const std::string& source = "SCENE");

}  // namespace ssphh::app
