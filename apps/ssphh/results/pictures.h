#pragma once
/// How pictures are written that commands made.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/pipeline/exposure.h>

namespace ssphh::app {

using pipeline::suitable_exposure;

/// The exposure of pictures that belong together: as asked for, else as suits the first of them that is not
/// black.
class SharedExposure {
 public:
  explicit SharedExposure(std::optional<float> asked, image::ToneCurve curve = image::ToneCurve::clip)
      : chosen_(asked), curve_(curve) {}

  /// EV for this picture and, if it is not black, for all that follow.
  float of(const image::Image& linear);
  /// What was asked for or chosen; none before there was light.
  std::optional<float> chosen() const { return chosen_; }

 private:
  std::optional<float> chosen_;
  image::ToneCurve curve_;
};

/// Whether a file of that name holds 8 bits that are shown as they are: PNG or JPEG.
bool is_display_format(const std::filesystem::path& path);

/// "exposure -7.25 EV"
std::string exposure_text(float exposure);

/// Tone mapped, whatever the format.
void write_display(const std::filesystem::path& path, const image::Image& linear, const image::ToneMap& map);

/// Linear radiance, or tone mapped where the format holds 8 bits.
void write_picture(const std::filesystem::path& path, const image::Image& linear, const image::ToneMap& map);

/// The name of a file that belongs to a picture: OUT.exr and "a.exr" give OUT.a.exr.
std::filesystem::path beside(const std::filesystem::path& picture, const std::string& ending);

/// Of names, parts of file names, each another: "desk lamp" gives "desk_lamp", and a second one that would,
/// "desk_lamp_2".
std::vector<std::string> file_parts(const std::vector<std::string>& names);

/// Per channel.
std::array<double, 3> mean_radiance(const image::Image& picture);

}  // namespace ssphh::app
