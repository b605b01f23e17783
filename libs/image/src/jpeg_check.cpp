#include <fmt/format.h>

#include "codec.h"

// stb fills up what is missing at the end of a truncated file with grey; that is an error here.

namespace ssphh::image {

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
    at += length;
  }
}

}  // namespace ssphh::image
