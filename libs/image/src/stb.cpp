#include <memory>

#include <fmt/format.h>

#include <ssphh/image/transfer.h>

#include "codec.h"

// Static, because other libraries in the same program carry stb's symbols too.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS (1 << 16)
#include <stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace ssphh::image {
namespace {

struct StbFree {
  void operator()(void* p) const { stbi_image_free(p); }
};

struct Info {
  int width = 0, height = 0, channels = 0;
};

const char* format_name(FileFormat format) {
  return format == FileFormat::png ? "PNG" : "JPEG";
}

const stbi_uc* bytes(const Source& source) {
  return reinterpret_cast<const stbi_uc*>(source.data.data());
}

int byte_count(const Source& source) {
  return static_cast<int>(source.data.size());
}

[[noreturn]] void fail(const Source& source, FileFormat format) {
  const char* reason = stbi_failure_reason();
  source.fail(fmt::format("broken {}: {}", format_name(format), reason ? reason : "unknown reason"));
}

Info check_header(const Source& source, FileFormat format) {
  if (source.data.size() > 0x7fffffff) source.fail("is larger than 2 GiB");
  if (format == FileFormat::png) check_png(source);
  if (format == FileFormat::jpeg) check_jpeg(source);
  Info info;
  if (!stbi_info_from_memory(bytes(source), byte_count(source), &info.width, &info.height, &info.channels)) {
    fail(source, format);
  }
  check_size(source, info.width, info.height);
  // stb counts bytes in int.
  constexpr std::int64_t most_bytes = 0x7fffffff;
  if (std::int64_t{info.width} * info.height * 8 > most_bytes) {
    source.fail(fmt::format("is {} x {} pixels, too many for an integer image", info.width, info.height));
  }
  return info;
}

// 1 and 2 channels are grey without and with alpha: alpha needs the four-channel form.
int image_channels(int stored) {
  return stored == 2 ? 4 : stored;
}

bool is_alpha(std::size_t index, int channels) {
  return channels == 4 && index % 4 == 3;
}

Image decode_8bit(const Source& source, FileFormat format, Info info) {
  const int channels = image_channels(info.channels);
  const std::unique_ptr<stbi_uc, StbFree> data(stbi_load_from_memory(
      bytes(source), byte_count(source), &info.width, &info.height, &info.channels, channels));
  if (!data) fail(source, format);
  Image image(info.width, info.height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const stbi_uc code = data.get()[i];
    image.pixels[i] = is_alpha(i, channels) ? static_cast<float>(code) / 255 : srgb8_to_linear(code);
  }
  return image;
}

Image decode_16bit(const Source& source, FileFormat format, Info info) {
  const int channels = image_channels(info.channels);
  const std::unique_ptr<stbi_us, StbFree> data(stbi_load_16_from_memory(
      bytes(source), byte_count(source), &info.width, &info.height, &info.channels, channels));
  if (!data) fail(source, format);
  Image image(info.width, info.height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float value = static_cast<float>(data.get()[i]) / 65535;
    image.pixels[i] = is_alpha(i, channels) ? value : srgb_to_linear(value);
  }
  return image;
}

std::vector<std::uint8_t> to_8bit(const Image& image) {
  std::vector<std::uint8_t> codes(image.pixels.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const float x = image.pixels[i];
    codes[i] = is_alpha(i, image.channels) ? unit_to_8bit(x) : linear_to_srgb8(x);
  }
  return codes;
}

std::vector<std::byte> encode_png(const std::uint8_t* codes, int width, int height, int channels) {
  if (std::int64_t{width} * height * channels > (1 << 30)) {
    throw Error("PNG", fmt::format("{} x {} pixels are too many", width, height));
  }
  int size = 0;
  const std::unique_ptr<stbi_uc, StbFree> data(
      stbi_write_png_to_mem(codes, width * channels, width, height, channels, &size));
  if (!data) throw std::bad_alloc();
  const auto* begin = reinterpret_cast<const std::byte*>(data.get());
  return {begin, begin + size};
}

void append(void* context, void* data, int size) {
  auto& out = *static_cast<std::vector<std::byte>*>(context);
  const auto* begin = static_cast<const std::byte*>(data);
  out.insert(out.end(), begin, begin + size);
}

}  // namespace

Image decode_stb(const Source& source, FileFormat format) {
  const Info info = check_header(source, format);
  return stbi_is_16_bit_from_memory(bytes(source), byte_count(source)) ? decode_16bit(source, format, info)
                                                                       : decode_8bit(source, format, info);
}

Rgba8 decode_stb_rgba8(const Source& source, FileFormat format) {
  Info info = check_header(source, format);
  const std::unique_ptr<stbi_uc, StbFree> data(
      stbi_load_from_memory(bytes(source), byte_count(source), &info.width, &info.height, &info.channels, 4));
  if (!data) fail(source, format);
  const std::size_t size =
      std::size_t{4} * static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height);
  return {info.width, info.height, {data.get(), data.get() + size}};
}

std::vector<std::byte> encode_png(const Image& image) {
  require_whole(image, "PNG");
  return encode_png(to_8bit(image).data(), image.width, image.height, image.channels);
}

std::vector<std::byte> encode_png(const Rgba8& image) {
  require(image.width > 0 && image.height > 0 &&
              image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                       static_cast<std::size_t>(image.height),
          "PNG", "the image's size and its bytes do not agree");
  return encode_png(image.rgba.data(), image.width, image.height, 4);
}

std::vector<std::byte> encode_jpeg(const Image& image, int quality) {
  require_whole(image, "JPEG");
  require(quality >= 1 && quality <= 100, "JPEG", "the quality must be 1..100");
  constexpr int largest_side = 65535;
  if (image.width > largest_side || image.height > largest_side) {
    throw Error("JPEG", fmt::format("{} x {} pixels are too many", image.width, image.height));
  }
  std::vector<std::byte> out;
  if (!stbi_write_jpg_to_func(append, &out, image.width, image.height, image.channels, to_8bit(image).data(),
                              quality)) {
    throw std::bad_alloc();
  }
  return out;
}

}  // namespace ssphh::image
