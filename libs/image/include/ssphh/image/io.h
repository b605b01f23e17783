#pragma once
/// Image files: OpenEXR, Radiance HDR, PNG and JPEG, from and to memory and disk; WebP from them.
///
/// Float images are scene-linear. 8- and 16-bit files are decoded from the sRGB transfer curve when they are
/// read into an Image and encoded with it (clamped to [0, 1], rounded to nearest) when written; alpha is
/// linear everywhere. Every reader throws Error naming the file and the place for broken, truncated,
/// unsupported or oversized content; sizes are checked before memory is taken.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/image/image.h>

namespace ssphh::image {

enum class FileFormat { exr, hdr, png, jpeg, webp };

/// What a file may ask for before any memory is taken.
struct DecodeLimits {
  int side = 65536;                               ///< width and height [pixels]
  std::uint64_t pixels = std::uint64_t{1} << 28;  ///< width × height
};

/// 8-bit RGBA as stored in the file (no transfer curve applied), 4·width·height bytes, row 0 on top.
struct Rgba8 {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// The format that the first bytes show, if any.
std::optional<FileFormat> format_of_content(std::span<const std::byte> data);

/// The format that an output's extension asks for (.exr .hdr .pic .png .jpg .jpeg, any case); throws Error
/// otherwise, for .webp too, which is not written.
FileFormat format_of_extension(const std::filesystem::path& path);

/// Reads a file of any format, recognised by its content. Grey files give 1 channel, others 3 or 4.
/// OpenEXR: half, float and integer channels of any compression, scanlines or tiles (full resolution level),
/// luminance/chroma included; the result covers the display window, black where the data window does not
/// reach. Without root channels R G B or Y, the first layer that has them is taken. Colours are as stored:
/// neither EXR's premultiplied alpha nor its chromaticities are converted (others than Rec.709 are warned
/// about). Radiance HDR: values are divided by the EXPOSURE of the header, as its specification asks. Pixels
/// that are NaN or infinite are kept, and counted in one warning.
Image read_image(const std::filesystem::path& path, const DecodeLimits& limits = {});

/// As read_image; `name` stands for the file in messages.
Image decode_image(std::span<const std::byte> data, const std::string& name, const DecodeLimits& limits = {});

/// PNG, JPEG and WebP to 8-bit RGBA, for textures; other formats are an Error. 16-bit PNG loses its low byte.
Rgba8 decode_rgba8(std::span<const std::byte> data, const std::string& name, const DecodeLimits& limits = {});

/// One more float channel for encode_exr, named as OpenEXR does ("Z", "albedo.R"), width·height values.
struct NamedChannel {
  std::string name;
  std::span<const float> values;
};

/// 32-bit float channels Y, RGB or RGBA, ZIP compression: every bit survives.
std::vector<std::byte> encode_exr(const Image& image, std::span<const NamedChannel> extra = {});

/// 16-bit float channels Y, RGB or RGBA, ZIP compression. Throws Error for values beyond 65504 and NaN.
std::vector<std::byte> encode_half_exr(const Image& image);

/// RGBE, run-length encoded, mantissas rounded to nearest: each channel is off by at most 1/256 of the
/// pixel's largest. RGBE holds no negative or infinite numbers: negatives and NaN become 0, too large values
/// the largest; alpha is lost.
std::vector<std::byte> encode_hdr(const Image& image);

/// 8-bit PNG with as many channels as the image.
std::vector<std::byte> encode_png(const Image& image);
std::vector<std::byte> encode_png(const Rgba8& image);

/// `quality` 1..100; alpha is lost.
std::vector<std::byte> encode_jpeg(const Image& image, int quality = 95);

/// Encodes by extension and replaces the file as a whole (ssphh::write_file). Warns once when values do not
/// survive the format (NaN or infinite pixels in anything but EXR).
void write_image(const std::filesystem::path& path, const Image& image);

}  // namespace ssphh::image
