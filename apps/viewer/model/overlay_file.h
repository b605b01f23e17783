#pragma once
/// Edits as an overlay (docs/scenes.md): a small file that names the scene, which stays as it is, and holds
/// what was changed in it.

#include <filesystem>
#include <string>
#include <vector>

#include <ssphh/core/json.h>

#include "document.h"

namespace ssphh::viewer {

inline constexpr std::string_view overlay_ending = ".ssphh.json";

/// What a scene was opened from: the file below all, and overlays on it, the lowest first.
struct OpenedFiles {
  std::string scene;  ///< file, or builtin:NAME
  std::vector<std::string> overlays;
};

/// As scene_io::load_scene() finds them. `overlay`: that was named for it; empty: none.
OpenedFiles opened_files(const std::string& source, const std::string& overlay);

/// The document's edits as an overlay for `folder`. Throws Error for what overlays cannot hold: materials
/// that have no name of their own.
json::Value overlay_of(const Document& document, const std::filesystem::path& folder);

}  // namespace ssphh::viewer
