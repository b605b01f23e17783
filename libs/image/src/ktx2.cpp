#include <array>

#include <ssphh/core/bytes.h>
#include <ssphh/core/require.h>
#include <ssphh/image/half.h>
#include <ssphh/image/ktx2.h>

namespace ssphh::image {
namespace {

using u8 = std::uint8_t;
using u16 = std::uint16_t;
using u32 = std::uint32_t;
using u64 = std::uint64_t;

constexpr std::array<u8, 12> identifier = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
constexpr u32 rgba16_sfloat = 97, type_size = 2, texel_size = 8;
constexpr u32 header_size = 80, level_index_size = 24;

/// Khronos Data Format 1.3, basic block: four signed float channels of 16 bits.
std::vector<std::byte> format_descriptor() {
  constexpr u16 channels = 4, block_size = 24 + 16 * channels;
  constexpr u8 model_rgbsda = 1, primaries_bt709 = 1, transfer_linear = 1, straight_alpha = 0;
  constexpr u8 signed_float = 0xc0;
  constexpr std::array<u8, channels> channel = {0, 1, 2, 15};  // alpha is 15
  ByteWriter out;
  out.value(u32{4} + block_size);
  out.value(u32{0});  // vendor and type: Khronos, basic
  out.value(u16{2}), out.value(block_size);
  out.value(model_rgbsda), out.value(primaries_bt709), out.value(transfer_linear), out.value(straight_alpha);
  out.value(u32{0});  // blocks of one texel
  out.value(u8{texel_size});
  for (int i = 0; i < 7; ++i) out.value(u8{0});  // no further planes
  for (u16 c = 0; c < channels; ++c) {
    out.value(static_cast<u16>(16 * c)), out.value(u8{15}),
        out.value(static_cast<u8>(channel[c] | signed_float));
    out.value(u32{0});                                       // at the texel's place
    out.value(u32{0xbf800000}), out.value(u32{0x3f800000});  // −1 and 1 as floats
  }
  return out.take();
}

}  // namespace

std::vector<std::byte> ktx2_of_halves(const glm::ivec3& size, std::span<const std::byte> texels) {
  require(size.x > 0 && size.y > 0 && size.z >= 0 &&
              texels.size() == texel_size * static_cast<u64>(size.x) * static_cast<u64>(size.y) *
                                   static_cast<u64>(std::max(size.z, 1)),
          "KTX2", "the texels are not those of such a size");
  const std::vector<std::byte> descriptor = format_descriptor();
  const u32 descriptor_at = header_size + level_index_size;
  const u64 end = descriptor_at + descriptor.size();
  const u64 texels_at = (end + texel_size - 1) / texel_size * texel_size;
  ByteWriter out;
  out.array(std::span<const u8>(identifier));
  out.value(rgba16_sfloat), out.value(type_size);
  for (int axis = 0; axis < 3; ++axis) out.value(static_cast<u32>(size[axis]));
  out.value(u32{0}), out.value(u32{1}), out.value(u32{1}),
      out.value(u32{0});  // layers, faces, levels, packing
  out.value(descriptor_at), out.value(static_cast<u32>(descriptor.size()));
  out.value(u32{0}), out.value(u32{0});  // no key/value data
  out.value(u64{0}), out.value(u64{0});  // no supercompression
  out.value(texels_at), out.value(u64{texels.size()}), out.value(u64{texels.size()});
  out.array(std::span<const std::byte>(descriptor));
  while (out.bytes().size() < texels_at) out.value(u8{0});
  out.array(texels);
  return out.take();
}

std::vector<std::byte> encode_ktx2(const Image& image) {
  require_whole(image, "KTX2");
  ByteWriter texels;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const vec3 colour = image.rgb(x, y);
      for (int c = 0; c < 3; ++c) texels.value(to_half(colour[c], "KTX2"));
      texels.value(to_half(image.channels == 4 ? image.at(x, y)[3] : 1.0f, "KTX2"));
    }
  }
  return ktx2_of_halves({image.width, image.height, 0}, texels.bytes());
}

}  // namespace ssphh::image
