#pragma once
/// Procedural scenes, addressed as "builtin:NAME".

#include <string>
#include <string_view>
#include <vector>

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

struct BuiltinScene {
  std::string name;         ///< without the "builtin:" prefix
  std::string description;  ///< one line
  Scene (*make)();
};

/// The visible table of all built-in scenes.
const std::vector<BuiltinScene>& builtin_scenes();

/// Throws Error that lists the known names.
Scene make_builtin(std::string_view name);

}  // namespace ssphh::scene
