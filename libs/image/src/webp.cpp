#include <webp/decode.h>

#include "codec.h"
#include "eight_bit.h"

namespace ssphh::image {
namespace {

const std::uint8_t* bytes_of(const Source& source) {
  return reinterpret_cast<const std::uint8_t*>(source.data.data());
}

WebPBitstreamFeatures read_header(const Source& source) {
  WebPBitstreamFeatures header;
  if (WebPGetFeatures(bytes_of(source), source.data.size(), &header) != VP8_STATUS_OK)
    source.fail("broken WebP: its header is damaged or cut short");
  if (header.has_animation) source.fail("is an animated WebP", "one picture is needed");
  check_size(source, header.width, header.height);
  return header;
}

/// 3 or 4 codes a pixel.
std::vector<std::uint8_t> decode(const Source& source, const WebPBitstreamFeatures& header,
                                 std::size_t channels) {
  const auto into = channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  const std::size_t row = channels * static_cast<std::size_t>(header.width);
  std::vector<std::uint8_t> codes(row * static_cast<std::size_t>(header.height));
  if (!into(bytes_of(source), source.data.size(), codes.data(), codes.size(), static_cast<int>(row)))
    source.fail("broken WebP: its pixels are damaged or cut short");
  return codes;
}

}  // namespace

Image decode_webp(const Source& source) {
  const WebPBitstreamFeatures header = read_header(source);
  const int channels = header.has_alpha ? 4 : 3;
  const std::vector<std::uint8_t> codes = decode(source, header, static_cast<std::size_t>(channels));
  Image image(header.width, header.height, channels);
  for (std::size_t i = 0; i < codes.size(); ++i)
    image.pixels[i] = decode_8bit(codes[i], is_alpha(i, channels));
  return image;
}

Rgba8 decode_webp_rgba8(const Source& source) {
  const WebPBitstreamFeatures header = read_header(source);
  return {header.width, header.height, decode(source, header, 4)};
}

}  // namespace ssphh::image
