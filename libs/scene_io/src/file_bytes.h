#pragma once
/// Bytes of files that a scene names, before anything is known of what they hold.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace ssphh::scene_io {

/// The largest file of a picture that is read [bytes].
inline constexpr std::uint64_t max_image_bytes = std::uint64_t{1} << 30;

/// The same bytes as text; they must outlive it.
inline std::string_view as_text(std::span<const std::byte> data) {
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

}  // namespace ssphh::scene_io
