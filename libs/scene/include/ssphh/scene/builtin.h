#pragma once
/// Procedural scenes, addressed as "builtin:NAME".

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// A scene that comes in many, as "builtin:NAME?KEY=NUMBER".
struct BuiltinNumber {
  std::string key;
  int least = 0, most = 0, usual = 0;  ///< usual: of "builtin:NAME" alone
  Scene (*make)(int);
};

struct BuiltinScene {
  std::string name;         ///< without the "builtin:" prefix
  std::string description;  ///< one line
  Scene (*make)();
  std::optional<BuiltinNumber> number = std::nullopt;
};

/// The visible table of all built-in scenes.
const std::vector<BuiltinScene>& builtin_scenes();

/// "NAME" or "NAME?KEY=NUMBER". Throws Error that lists the known names, or says what number is wanted.
Scene make_builtin(std::string_view name);

}  // namespace ssphh::scene
