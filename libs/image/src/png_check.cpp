#include <array>

#include <fmt/format.h>

#include "codec.h"

// stb trusts lengths and ignores checksums; a damaged reference image must not pass as a good one.

namespace ssphh::image {
namespace {

std::uint32_t big_endian(const Source& source, std::size_t at) {
  return std::uint32_t{source.byte(at)} << 24 | std::uint32_t{source.byte(at + 1)} << 16 |
         std::uint32_t{source.byte(at + 2)} << 8 | source.byte(at + 3);
}

struct PngHeader {
  std::uint64_t width = 0, height = 0, bits = 0;  // bits per pixel
};

PngHeader read_header(const Source& source, std::size_t data, std::uint32_t length) {
  if (length != 13) source.fail("broken PNG: IHDR of a wrong length");
  static constexpr std::array<std::uint64_t, 7> samples{1, 0, 3, 1, 2, 0, 4};
  const std::uint8_t type = source.byte(data + 9);
  return {big_endian(source, data), big_endian(source, data + 4),
          type < samples.size() ? source.byte(data + 8) * samples[type] : 0};
}

}  // namespace

std::uint32_t png_crc(std::span<const std::byte> data) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < t.size(); ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
      t[i] = c;
    }
    return t;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const std::byte b : data) crc = table[(crc ^ std::to_integer<std::uint32_t>(b)) & 255] ^ (crc >> 8);
  return ~crc;
}

void check_png(const Source& source) {
  constexpr std::size_t signature = 8, overhead = 12;
  PngHeader header;
  std::uint64_t compressed = 0;
  bool ended = false;
  for (std::size_t at = signature; !ended;) {
    if (source.data.size() - at < overhead)
      source.fail(fmt::format("broken PNG: ends too early (byte {})", at));
    const std::uint32_t length = big_endian(source, at);
    if (length > source.data.size() - at - overhead) {
      source.fail(fmt::format("broken PNG: chunk of {} bytes leaves the file (byte {})", length, at));
    }
    const auto type = std::string_view(reinterpret_cast<const char*>(source.data.data()) + at + 4, 4);
    const bool critical = (type[0] & 0x20) == 0;
    const std::uint32_t crc = big_endian(source, at + 8 + length);
    if (critical && crc != png_crc(source.data.subspan(at + 4, std::size_t{length} + 4))) {
      source.fail(fmt::format("broken PNG: wrong checksum of the chunk at byte {}", at));
    }
    if ((type == "IHDR") != (at == signature))
      source.fail(fmt::format("broken PNG: misplaced IHDR (byte {})", at));
    if (type == "IHDR") header = read_header(source, at + 8, length);
    if (type == "IDAT") compressed += length;
    ended = type == "IEND";
    at += length + overhead;
  }
  check_size(source, static_cast<std::int64_t>(header.width), static_cast<std::int64_t>(header.height));
  // Deflate reaches 1032:1 at best.
  if (header.width * header.height * header.bits / 8 > (compressed + 16) * 1032) {
    source.fail(fmt::format("broken PNG: {} compressed bytes cannot hold {} x {} pixels", compressed,
                            header.width, header.height));
  }
}

}  // namespace ssphh::image
