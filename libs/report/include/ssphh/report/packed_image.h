#pragma once
/// Pictures small enough for a page, unpacked by the browser (page/unpack.js).

#include <cstdint>
#include <string>
#include <vector>

#include <ssphh/image/image.h>

namespace ssphh::report {

/// A lossless packing of 16-bit values. Channels are decorrelated (the first and third keep their difference
/// to the second, modulo 2^16), then each value keeps its difference to its left neighbour (the first of a
/// row to the one above), then low and high bytes are stored apart, channel by channel, and deflated (zlib).
/// Neighbouring halves of like exponent differ little as integers, and the channels of a noisy grey more or
/// less together: that is what makes the planes compress.
struct PackedImage {
  int width = 0, height = 0, channels = 3;
  std::string kind;                 ///< "half" (IEEE 754 binary16) or "byte" (0..255 for 0..1)
  std::vector<std::uint8_t> bytes;  ///< zlib stream
};

/// IEEE 754 binary16 of a float, rounded to nearest even; beyond ±65504 becomes ±65504, NaN stays NaN.
std::uint16_t to_half(float value);

/// Alpha is left out.
PackedImage pack_half(const image::Image& image);
/// One channel in [0, 1], rounded to 1/255; NaN is 0.
PackedImage pack_bytes(const image::Image& image);

/// The 16-bit values as they were before packing, interleaved. Throws Error for a broken stream.
std::vector<std::uint16_t> unpack(const PackedImage& packed);

/// Bytes as text of UTF-16 code units, 15 bits in each, most significant first and zeros at the end: U+3400
/// to U+B3FF, which are all letters that no parser changes. In UTF-16 it is a fifteenth larger than the
/// bytes; base64 would be a third.
std::u16string base32768(const std::vector<std::uint8_t>& bytes);

}  // namespace ssphh::report
