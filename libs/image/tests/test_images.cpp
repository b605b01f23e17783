#include "test_images.h"

#include <span>

#include <boost/crc.hpp>

#include <ssphh/image/io.h>

#include "error_message.h"

namespace ssphh::image::test {
namespace {

void append_u32(std::vector<std::byte>& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(value >> shift & 255));
}

std::uint32_t crc_of(std::span<const std::byte> data) {
  boost::crc_32_type crc;
  crc.process_bytes(data.data(), data.size());
  return crc.checksum();
}

void append_chunk(std::vector<std::byte>& out, const std::string& type,
                  const std::vector<std::uint8_t>& data) {
  append_u32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = out.size();
  for (const char c : type) out.push_back(static_cast<std::byte>(c));
  for (const std::uint8_t b : data) out.push_back(static_cast<std::byte>(b));
  append_u32(out, crc_of(std::span(out).subspan(begin)));
}

}  // namespace

std::vector<std::byte> png_row(int width, int depth, int color_type, const std::vector<std::uint8_t>& samples,
                               const std::vector<PngChunk>& chunks) {
  std::vector<std::byte> out;
  for (const int c : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a})
    out.push_back(static_cast<std::byte>(c));
  append_chunk(out, "IHDR",
               {0, 0, 0, static_cast<std::uint8_t>(width), 0, 0, 0, 1, static_cast<std::uint8_t>(depth),
                static_cast<std::uint8_t>(color_type), 0, 0, 0});
  for (const auto& [type, data] : chunks) append_chunk(out, type, data);
  // One stored (uncompressed) deflate block: filter byte 0 and the samples; then Adler-32.
  std::vector<std::uint8_t> line{0};
  line.insert(line.end(), samples.begin(), samples.end());
  const auto size = static_cast<std::uint8_t>(line.size());
  std::vector<std::uint8_t> zlib{0x78, 0x01, 0x01, size, 0, static_cast<std::uint8_t>(~size), 0xff};
  zlib.insert(zlib.end(), line.begin(), line.end());
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t v : line) a = (a + v) % 65521, b = (b + a) % 65521;
  for (const std::uint32_t v : {b >> 8, b & 255, a >> 8, a & 255})
    zlib.push_back(static_cast<std::uint8_t>(v));
  append_chunk(out, "IDAT", zlib);
  append_chunk(out, "IEND", {});
  return out;
}

std::vector<std::byte> png_16bit_grey(const std::vector<std::uint16_t>& row) {
  std::vector<std::uint8_t> samples;
  for (const std::uint16_t v : row) {
    samples.push_back(static_cast<std::uint8_t>(v >> 8));
    samples.push_back(static_cast<std::uint8_t>(v & 255));
  }
  return png_row(static_cast<int>(row.size()), 16, 0, samples);
}

std::string said_of(std::span<const std::byte> file) {
  return message_of([&] { decode_image(file, "f"); });
}

}  // namespace ssphh::image::test
