#pragma once
/// A first, suspicious look at an OpenEXR file, before OpenEXR itself allocates what the header asks for.

#include <cstdint>
#include <string>
#include <vector>

#include "codec.h"

namespace ssphh::image {

struct ExrWindow {
  std::int64_t min_x = 0, min_y = 0, max_x = -1, max_y = -1;
  std::int64_t width() const { return max_x - min_x + 1; }
  std::int64_t height() const { return max_y - min_y + 1; }
};

struct ExrChannel {
  std::string name;
  bool subsampled = false;
  int bytes = 4;
};

struct ExrHeader {
  ExrWindow data, display;
  std::vector<ExrChannel> channels;
  int compression = 0;
  bool tiled = false, deep = false;
  std::int64_t tile_width = 0, tile_height = 0;
  std::int64_t chunks = 0;  ///< at least so many chunks, 8 bytes each in the offset table
};

/// The headers of all parts. Throws Error when one is malformed, asks for more than the limits, or the tables
/// that must follow cannot be in the file.
std::vector<ExrHeader> check_exr_headers(const Source& source);

}  // namespace ssphh::image
