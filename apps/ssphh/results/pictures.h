#pragma once
/// How pictures are written that commands made.

#include <array>
#include <filesystem>
#include <string>

#include <ssphh/image/image.h>
#include <ssphh/image/tonemap.h>

namespace ssphh::app {

/// Tone mapped, whatever the format.
void write_display(const std::filesystem::path& path, const image::Image& linear, const image::ToneMap& map);

/// Linear radiance, or tone mapped where the format holds 8 bits.
void write_picture(const std::filesystem::path& path, const image::Image& linear, const image::ToneMap& map);

/// The name of a file that belongs to a picture: OUT.exr and "a.exr" give OUT.a.exr.
std::filesystem::path beside(const std::filesystem::path& picture, const std::string& ending);

/// Per channel.
std::array<double, 3> mean_radiance(const image::Image& picture);

}  // namespace ssphh::app
