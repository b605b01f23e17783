#include "texture_files.h"

#include <utility>

#include <fmt/format.h>

#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>

namespace ssphh::scene_io {
namespace {

using image::Image;

Image colors_of(const scene::Texture& texture, const vec3& factor) {
  Image result(texture.width, texture.height);
  for (std::size_t i = 0; i < result.pixels.size() / 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      result.pixels[3 * i + c] =
          factor[static_cast<int>(c)] * image::srgb8_to_linear(texture.rgba[4 * i + c]);
    }
  }
  return result;
}

}  // namespace

TextureFiles::TextureFiles(const scene::Scene& scene, std::filesystem::path directory)
    : scene_(scene), directory_(std::move(directory)) {}

std::string TextureFiles::once(const std::string& key, const std::string& name,
                               const std::function<Image()>& make) {
  const auto [place, is_new] = names_.emplace(key, name);
  if (!is_new) return place->second;
  image::write_image(directory_ / name, make());
  written_.push_back(directory_ / name);
  return name;
}

std::string TextureFiles::color(int texture, const vec3& factor) {
  if (factor != vec3(1)) return linear_color(texture, factor);
  // PNG encodes what the codes decode to: the same codes again.
  return once(fmt::format("color {}", texture), fmt::format("texture{}.png", texture),
              [&] { return colors_of(scene_.textures[texture], vec3(1)); });
}

std::string TextureFiles::linear_color(int texture, const vec3& factor) {
  return once(fmt::format("color {} times {} {} {}", texture, factor.x, factor.y, factor.z),
              fmt::format("texture{}-{}.exr", texture, names_.size()),
              [&] { return colors_of(scene_.textures[texture], factor); });
}

std::string TextureFiles::channel(int texture, int channel, const std::string& kind,
                                  const std::function<float(float)>& map) {
  const auto make = [&] {
    const scene::Texture& source = scene_.textures[texture];
    Image result(source.width, source.height);
    for (std::size_t i = 0; i < result.pixels.size() / 3; ++i) {
      const float value =
          map(static_cast<float>(source.rgba[4 * i + static_cast<std::size_t>(channel)]) / 255);
      for (std::size_t c = 0; c < 3; ++c) result.pixels[3 * i + c] = value;
    }
    return result;
  };
  return once(fmt::format("channel {} {} {}", texture, channel, kind),
              fmt::format("texture{}-{}.exr", texture, names_.size()), make);
}

std::string TextureFiles::image(const std::string& name, const Image& image) {
  return once(name, name, [&] { return image; });
}

}  // namespace ssphh::scene_io
