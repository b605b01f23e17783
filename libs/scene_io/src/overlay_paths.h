#pragma once

#include <filesystem>

#include "json_view.h"

namespace ssphh::scene_io {

/// File that a member of an overlay names: variables expanded, relative to the overlay.
std::filesystem::path overlay_path(const JsonView& member, const std::filesystem::path& overlay);

}  // namespace ssphh::scene_io
