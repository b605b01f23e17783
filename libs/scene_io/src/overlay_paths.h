#pragma once

#include <cstdint>
#include <filesystem>

#include <ssphh/core/json_cursor.h>

namespace ssphh::scene_io {

inline constexpr std::uint64_t max_overlay_bytes = std::uint64_t{16} << 20;

/// File that a member of an overlay names: variables expanded, relative to the overlay.
std::filesystem::path overlay_path(const json::Cursor& member, const std::filesystem::path& overlay);

}  // namespace ssphh::scene_io
