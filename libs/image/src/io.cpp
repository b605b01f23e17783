#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>

#include "codec.h"

namespace ssphh::image {
namespace {

bool starts_with(std::span<const std::byte> data, std::string_view magic) {
  return data.size() >= magic.size() && std::memcmp(data.data(), magic.data(), magic.size()) == 0;
}

std::size_t count_nonfinite_pixels(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
    const auto first = image.pixels.begin() + static_cast<std::ptrdiff_t>(i);
    if (!std::all_of(first, first + image.channels, [](float x) { return std::isfinite(x); })) ++count;
  }
  return count;
}

FileFormat require_format(const Source& source) {
  if (source.data.empty()) source.fail("is empty");
  const auto format = format_of_content(source.data);
  if (!format) source.fail("is no image that can be read", "OpenEXR, Radiance HDR, PNG, JPEG and WebP are");
  return *format;
}

}  // namespace

void check_size(const Source& source, std::int64_t width, std::int64_t height) {
  if (width <= 0 || height <= 0) source.fail(fmt::format("has no pixels: {} x {}", width, height));
  const DecodeLimits& limits = source.limits;
  if (width > limits.side || height > limits.side) {
    source.fail(fmt::format("is {} x {} pixels, the limit is {} per side", width, height, limits.side));
  }
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels > limits.pixels) {
    source.fail(fmt::format("is {} x {} pixels, the limit is {} in all", width, height, limits.pixels));
  }
  // The best codecs reach some thousand pixels per byte on empty images; small ones may be as sparse as they
  // like.
  constexpr std::uint64_t always_allowed = std::uint64_t{1} << 24, pixels_per_byte = 4096;
  if (pixels > always_allowed && pixels / pixels_per_byte > source.data.size()) {
    source.fail(fmt::format("announces {} x {} pixels in only {} bytes", width, height, source.data.size()));
  }
}

std::optional<FileFormat> format_of_content(std::span<const std::byte> data) {
  if (starts_with(data, "\x76\x2f\x31\x01")) return FileFormat::exr;
  if (starts_with(data, "#?")) return FileFormat::hdr;
  if (starts_with(data, "\x89PNG\r\n\x1a\n")) return FileFormat::png;
  if (starts_with(data, "\xff\xd8\xff")) return FileFormat::jpeg;
  if (starts_with(data, "RIFF") && data.size() >= 12 && starts_with(data.subspan(8), "WEBP"))
    return FileFormat::webp;
  return std::nullopt;
}

FileFormat format_of_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (extension == ".exr") return FileFormat::exr;
  if (extension == ".hdr" || extension == ".pic") return FileFormat::hdr;
  if (extension == ".png") return FileFormat::png;
  if (extension == ".jpg" || extension == ".jpeg") return FileFormat::jpeg;
  throw Error(path.string(), fmt::format("unknown image extension '{}'", extension),
              "use .exr, .hdr, .png or .jpg");
}

Image decode_image(std::span<const std::byte> data, const std::string& name, const DecodeLimits& limits) {
  const Source source{data, name, limits};
  const FileFormat format = require_format(source);
  Image image = format == FileFormat::exr    ? decode_exr(source)
                : format == FileFormat::hdr  ? decode_hdr(source)
                : format == FileFormat::png  ? decode_png(source)
                : format == FileFormat::jpeg ? decode_jpeg(source)
                                             : decode_webp(source);
  if (const std::size_t count = count_nonfinite_pixels(image)) {
    log_warning("{}: {} of {} pixels are infinite or NaN", name, count,
                image.pixels.size() / static_cast<std::size_t>(image.channels));
  }
  return image;
}

Image read_image(const std::filesystem::path& path, const DecodeLimits& limits) {
  return decode_image(read_file(path), path.string(), limits);
}

Rgba8 decode_rgba8(std::span<const std::byte> data, const std::string& name, const DecodeLimits& limits) {
  const Source source{data, name, limits};
  const FileFormat format = require_format(source);
  switch (format) {
    case FileFormat::png:
      return decode_png_rgba8(source);
    case FileFormat::jpeg:
      return decode_jpeg_rgba8(source);
    case FileFormat::webp:
      return decode_webp_rgba8(source);
    case FileFormat::exr:
    case FileFormat::hdr:
      break;
  }
  source.fail("is not an 8-bit image", "use PNG, JPEG or WebP");
}

void write_image(const std::filesystem::path& path, const Image& image) {
  const FileFormat format = format_of_extension(path);
  if (format != FileFormat::exr) {
    if (const std::size_t count = count_nonfinite_pixels(image)) {
      log_warning("{}: {} pixels are infinite or NaN, which this format cannot hold", path.string(), count);
    }
  }
  write_file(path, format == FileFormat::exr   ? encode_exr(image)
                   : format == FileFormat::hdr ? encode_hdr(image)
                   : format == FileFormat::png ? encode_png(image)
                                               : encode_jpeg(image));
}

}  // namespace ssphh::image
