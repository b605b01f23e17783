#pragma once
/// `ssphh scene`: which scenes are built in, and what a scene holds.

#include <cstdint>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/json.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "options/scene_options.h"

namespace ssphh::app {

struct SceneListOptions {};

struct SceneListResult {
  std::vector<scene::BuiltinScene> scenes;  ///< all, in the library's order
};

/// Throws nothing.
SceneListResult run_scene_list(const SceneListOptions& options = {}, const Control& control = {});

json::Value to_json(const SceneListResult& result, const SceneListOptions& options);
std::string to_text(const SceneListResult& result, const SceneListOptions& options);

/// Counts are of the scene's arrays unless they say otherwise.
struct SceneInfo {
  std::string name;             ///< as its file gives it; may be empty
  std::uint64_t triangles = 0;  ///< counted once per instance
  std::size_t meshes = 0, instances = 0, materials = 0, textures = 0, lights = 0, animations = 0;
  std::size_t emissive_instances = 0;              ///< those whose material emits light
  std::size_t glass_sheets = 0, glass_bodies = 0;  ///< instances that light may go through
  std::size_t movable = 0;                         ///< nodes that are animated or stand below such
  bool environment = false;                        ///< there is one
  std::vector<std::string> light_groups;           ///< names, in order of first use
  std::vector<std::pair<std::string, scene::LightType>> lamps;  ///< names and types
  /// Lamps with a photometric profile, and the name of its file.
  std::vector<std::pair<std::string, std::string>> lamp_profiles;
  std::vector<std::string> cameras;       ///< names
  std::vector<std::string> sphls;         ///< names, of disabled ones too
  std::vector<scene::ProbePlace> places;  ///< of the enabled SPHLs, at the options' time
  float animation_seconds = 0;            ///< time of the last key; 0 without animations
  scene::Bounds bounds;                   ///< of all vertices at the options' time, in metres; may be empty
  Hash128 hash;                           ///< scene::scene_hash
  std::vector<std::string> ignored;       ///< what its file holds and nothing uses, a line each
};

/// Throws Error for a scene that cannot be read. Too short to be cancelled or to tell of its progress.
SceneInfo run_scene_info(const SceneOptions& options, const Control& control = {});

json::Value to_json(const SceneInfo& info, const SceneOptions& options);
std::string to_text(const SceneInfo& info, const SceneOptions& options);

}  // namespace ssphh::app
