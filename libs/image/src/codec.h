#pragma once
/// The decoders behind io.h, and the limits they share.

#include <cstdint>
#include <string>

#include <ssphh/image/io.h>

namespace ssphh::image {

/// A file in memory, its name for messages, and what it may ask for.
struct Source {
  std::span<const std::byte> data;
  const std::string& name;
  const DecodeLimits& limits;

  std::uint8_t byte(std::size_t i) const { return std::to_integer<std::uint8_t>(data[i]); }
  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const {
    throw Error(name, problem, hint);
  }
};

/// Throws Error when width × height is empty, over the limits, or far more than so few bytes can hold.
void check_size(const Source& source, std::int64_t width, std::int64_t height);

Image decode_exr(const Source& source);
Image decode_hdr(const Source& source);

/// Through libspng, every checksum held.
Image decode_png(const Source& source);
Rgba8 decode_png_rgba8(const Source& source);

/// Through libjpeg-turbo, to which a damaged file is none.
Image decode_jpeg(const Source& source);
Rgba8 decode_jpeg_rgba8(const Source& source);

/// Through libwebp; one picture, no animation.
Image decode_webp(const Source& source);
Rgba8 decode_webp_rgba8(const Source& source);

}  // namespace ssphh::image
