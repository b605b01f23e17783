#include "results/pictures.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/image/io.h>

namespace ssphh::app {

float SharedExposure::of(const image::Image& linear) {
  if (chosen_) return *chosen_;
  const auto is_light = [](float x) { return x > 0 && std::isfinite(x); };
  if (std::ranges::any_of(linear.pixels, is_light)) chosen_ = suitable_exposure(linear, curve_);
  return chosen_.value_or(0);
}

bool is_display_format(const std::filesystem::path& path) {
  const image::FileFormat format = image::format_of_extension(path);
  return format == image::FileFormat::png || format == image::FileFormat::jpeg;
}

std::string exposure_text(float exposure) {
  return fmt::format("exposure {:+.2f} EV", exposure);
}

void write_display(const std::filesystem::path& path, const image::Image& linear, const image::ToneMap& map) {
  image::write_image(path, image::tone_map(linear, map));
}

void write_picture(const std::filesystem::path& path, const image::Image& linear, const image::ToneMap& map) {
  if (is_display_format(path)) {
    write_display(path, linear, map);
  } else {
    image::write_image(path, linear);
  }
}

std::filesystem::path beside(const std::filesystem::path& picture, const std::string& ending) {
  return (picture.parent_path() / picture.stem()).string() + "." + ending;
}

std::vector<std::string> file_parts(const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (const std::string& name : names) {
    std::string plain = name;
    for (char& c : plain) c = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    std::string part = plain;
    for (int k = 2; std::ranges::find(parts, part) != parts.end(); ++k) part = fmt::format("{}_{}", plain, k);
    parts.push_back(std::move(part));
  }
  return parts;
}

std::array<double, 3> mean_radiance(const image::Image& picture) {
  std::array<double, 3> mean{};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) mean[c] += static_cast<double>(picture.rgb(x, y)[c]);
    }
  }
  for (double& m : mean) m /= static_cast<double>(picture.width) * picture.height;
  return mean;
}

}  // namespace ssphh::app
