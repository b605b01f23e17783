#pragma once

#include <filesystem>

#include <ssphh/core/json_cursor.h>

namespace ssphh::scene_io {

/// File that a member of an overlay names: variables expanded, relative to the overlay.
std::filesystem::path overlay_path(const json::Cursor& member, const std::filesystem::path& overlay);

}  // namespace ssphh::scene_io
