#pragma once
/// Lamps that the page of `ssphh web` drags: what each is, and its indirect light at the places of a lattice.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/json.h>
#include <ssphh/pipeline/lamp_lattice.h>
#include <ssphh/probes/probe_set.h>

#include "commands/web_stage.h"

namespace ssphh::app {

struct WebLamp {
  std::string name, group;
  std::size_t light = 0;  ///< of the scene's
  pipeline::LampLattice lattice;
  std::string boxes;  ///< file of what each box of the lattice sees
  std::vector<std::string>
      textures;  ///< a file for each pose: the lightmaps of all places, one below another
};

struct WebLamps {
  const scene::Scene* scene = nullptr;
  std::vector<WebLamp> lamps;
  lightmap::Layout layout;  ///< of their lightmaps
  std::string charts;       ///< file that leads from the scene's lightmap to theirs
  float time = 0;           ///< at which the lamps are where they are [s]
};

/// The lamps that the options name, with what the page needs to know of them before any light; none asked
/// for: none. Throws Error for a name that there is not, for lamps that cannot be moved, and as
/// pipeline::lamp_lattice does; Cancelled when asked to stop.
WebLamps find_web_lamps(const LitStage& stage, std::span<const float> times, std::vector<FolderFile>& files,
                        const Control& control);

/// Adds the light of all lamps at their places in the pose of `time` [s], whose baked set this is.
void add_lamp_pose(const LitStage& stage, const probes::ProbeSet& set, float time, WebLamps& lamps,
                   std::vector<FolderFile>& files, const Control& control);

/// As scene.json has it.
json::Value to_json(const WebLamps& lamps);

}  // namespace ssphh::app
