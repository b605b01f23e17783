#include <algorithm>
#include <bit>
#include <cmath>

#include <zlib.h>

#include <ssphh/core/require.h>
#include <ssphh/report/packed_image.h>

namespace ssphh::report {
namespace {

// In place, value by value from the end so that what is subtracted is still whole.
void to_differences(std::vector<std::uint16_t>& v, int width, int height, int channels) {
  const std::size_t c = static_cast<std::size_t>(channels), w = static_cast<std::size_t>(width);
  if (channels == 3) {
    for (std::size_t i = 0; i < v.size(); i += 3) {
      v[i] = static_cast<std::uint16_t>(v[i] - v[i + 1]);
      v[i + 2] = static_cast<std::uint16_t>(v[i + 2] - v[i + 1]);
    }
  }
  for (std::size_t pixel = w * static_cast<std::size_t>(height); pixel-- > 1;) {
    const std::size_t before = pixel % w != 0 ? pixel - 1 : pixel - w;
    for (std::size_t k = 0; k < c; ++k)
      v[pixel * c + k] = static_cast<std::uint16_t>(v[pixel * c + k] - v[before * c + k]);
  }
}

void from_differences(std::vector<std::uint16_t>& v, int width, int height, int channels) {
  const std::size_t c = static_cast<std::size_t>(channels), w = static_cast<std::size_t>(width);
  for (std::size_t pixel = 1; pixel < w * static_cast<std::size_t>(height); ++pixel) {
    const std::size_t before = pixel % w != 0 ? pixel - 1 : pixel - w;
    for (std::size_t k = 0; k < c; ++k)
      v[pixel * c + k] = static_cast<std::uint16_t>(v[pixel * c + k] + v[before * c + k]);
  }
  if (channels == 3) {
    for (std::size_t i = 0; i < v.size(); i += 3) {
      v[i] = static_cast<std::uint16_t>(v[i] + v[i + 1]);
      v[i + 2] = static_cast<std::uint16_t>(v[i + 2] + v[i + 1]);
    }
  }
}

PackedImage pack(std::vector<std::uint16_t> values, int width, int height, int channels, const char* kind) {
  to_differences(values, width, height, channels);
  const std::size_t count = values.size(), pixels = count / static_cast<std::size_t>(channels);
  std::vector<std::uint8_t> planes(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at =
        i % static_cast<std::size_t>(channels) * pixels + i / static_cast<std::size_t>(channels);
    planes[at] = static_cast<std::uint8_t>(values[i]);
    planes[count + at] = static_cast<std::uint8_t>(values[i] >> 8);
  }
  PackedImage packed{width, height, channels, kind, {}};
  uLongf size = ::compressBound(planes.size());
  packed.bytes.resize(size);
  SSPHH_CHECK(::compress2(packed.bytes.data(), &size, planes.data(), planes.size(), 7) == Z_OK);
  packed.bytes.resize(size);
  return packed;
}

}  // namespace

std::uint16_t to_half(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000u;
  if (std::isnan(value)) return static_cast<std::uint16_t>(sign | 0x7e00u);
  const float magnitude = std::min(std::abs(value), 65504.0f);
  if (magnitude < 0x1p-14f)  // subnormal: multiples of 2^-24; nearbyint rounds to even
    return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(std::nearbyint(magnitude * 0x1p24f)));
  std::uint32_t m = std::bit_cast<std::uint32_t>(magnitude) - (112u << 23);
  m += 0xfffu + (m >> 13 & 1u);
  return static_cast<std::uint16_t>(sign | std::min(m >> 13, 0x7bffu));
}

PackedImage pack_half(const image::Image& image) {
  image::require_whole(image, "packed image");
  const int channels = image.channels == 1 ? 1 : 3;
  std::vector<std::uint16_t> values;
  values.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                 static_cast<std::size_t>(channels));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < channels; ++c) values.push_back(to_half(image.at(x, y)[c]));
    }
  }
  return pack(std::move(values), image.width, image.height, channels, "half");
}

PackedImage pack_bytes(const image::Image& image) {
  image::require_whole(image, "packed image");
  std::vector<std::uint16_t> values;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float value = *image.at(x, y);
      values.push_back(static_cast<std::uint16_t>(
          std::isnan(value) ? 0 : std::lround(255 * std::clamp(value, 0.0f, 1.0f))));
    }
  }
  return pack(std::move(values), image.width, image.height, 1, "byte");
}

std::vector<std::uint16_t> unpack(const PackedImage& packed) {
  constexpr int largest_side = 65536;
  require(packed.width >= 1 && packed.height >= 1 && packed.width <= largest_side &&
              packed.height <= largest_side && (packed.channels == 1 || packed.channels == 3),
          "packed image", "its size makes no sense");
  const std::size_t channels = static_cast<std::size_t>(packed.channels);
  const std::size_t pixels = static_cast<std::size_t>(packed.width) * static_cast<std::size_t>(packed.height);
  const std::size_t count = pixels * channels;
  std::vector<std::uint8_t> planes(2 * count);
  uLongf size = planes.size();
  if (::uncompress(planes.data(), &size, packed.bytes.data(), packed.bytes.size()) != Z_OK ||
      size != planes.size())
    throw Error("packed image", "the stream is broken");
  std::vector<std::uint16_t> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i % channels * pixels + i / channels;
    values[i] = static_cast<std::uint16_t>(planes[at] | planes[count + at] << 8);
  }
  from_differences(values, packed.width, packed.height, packed.channels);
  return values;
}

std::u16string base32768(const std::vector<std::uint8_t>& bytes) {
  std::u16string text;
  text.reserve(bytes.size() * 8 / 15 + 1);
  std::uint32_t bits = 0;
  int count = 0;
  const auto put = [&](std::uint32_t value) { text += static_cast<char16_t>(0x3400u + (value & 0x7fffu)); };
  for (const std::uint8_t byte : bytes) {
    bits = bits << 8 | byte;
    if ((count += 8) >= 15) put(bits >> (count -= 15));
  }
  if (count > 0) put(bits << (15 - count));
  return text;
}

}  // namespace ssphh::report
