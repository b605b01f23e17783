#include <fmt/format.h>

#include "codec.h"

// What stb would pass or fall over: it fills up the missing end of a file with grey, and trusts Huffman
// tables.

namespace ssphh::image {
namespace {

// Huffman tables, `size` bytes at `at`: class and identity, 16 counts of codes by length, then one value for
// each code. stb writes behind its tables when the counts add up to more than 256.
void check_huffman_tables(const Source& source, std::size_t at, std::size_t size) {
  while (size > 0) {
    std::size_t codes = 0;
    for (std::size_t i = 1; i <= 16 && i < size; ++i) codes += source.byte(at + i);
    if (codes > 256 || 17 + codes > size) {
      source.fail(fmt::format("broken JPEG: Huffman table of {} codes (byte {})", codes, at));
    }
    at += 17 + codes, size -= 17 + codes;
  }
}

}  // namespace

void check_jpeg(const Source& source) {
  const std::size_t size = source.data.size();
  std::size_t at = 2;  // behind SOI
  const auto ends_early = [&]() { source.fail(fmt::format("broken JPEG: ends too early (byte {})", at)); };
  for (;;) {
    while (at < size && source.byte(at) != 0xff) ++at;
    while (at < size && source.byte(at) == 0xff) ++at;
    if (at >= size) ends_early();
    const std::uint8_t marker = source.byte(at++);
    if (marker == 0xd9) return;                                                      // EOI
    if (marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8)) continue;  // no segment follows
    if (size - at < 2) ends_early();
    const std::size_t length = std::size_t{source.byte(at)} << 8 | source.byte(at + 1);
    if (length < 2 || length > size - at) {
      source.fail(fmt::format("broken JPEG: segment of {} bytes leaves the file (byte {})", length, at));
    }
    if (marker == 0xc4) check_huffman_tables(source, at + 2, length - 2);
    at += length;
  }
}

}  // namespace ssphh::image
