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

/// PNG and JPEG through stb.
Image decode_stb(const Source& source, FileFormat format);
Rgba8 decode_stb_rgba8(const Source& source, FileFormat format);

/// Throws Error when a PNG's chunks do not fit the file, a critical chunk's checksum is wrong, or its
/// compressed data cannot hold the announced image.
void check_png(const Source& source);

/// CRC-32 as PNG uses it, of the bytes of a chunk's type and data.
std::uint32_t png_crc(std::span<const std::byte> data);

/// Throws Error when a JPEG's segments do not fit the file, its end is missing or a Huffman table is too
/// long.
void check_jpeg(const Source& source);

}  // namespace ssphh::image
