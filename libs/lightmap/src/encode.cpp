#include <algorithm>
#include <cmath>

#include <ssphh/lightmap/encode.h>

namespace ssphh::lightmap {
namespace {

constexpr float reach = 8;

}  // namespace

Rgbm encode_rgbm(const image::Image& linear) {
  image::require_whole(linear, "RGBM");
  require(linear.channels == 3, "RGBM", "an image of three channels is needed");
  float largest = 0;
  for (const float value : linear.pixels) {
    require(std::isfinite(value), "RGBM", "a value is not finite");
    largest = std::max(largest, value);
  }
  Rgbm out{{linear.width, linear.height, {}}, std::max(1.0f, largest / (reach * reach))};
  out.picture.rgba.reserve(linear.pixels.size() / 3 * 4);
  for (std::size_t i = 0; i < linear.pixels.size(); i += 3) {
    const vec3 root =
        glm::sqrt(glm::max(vec3(linear.pixels[i], linear.pixels[i + 1], linear.pixels[i + 2]), 0.0f) /
                  out.scale) /
        reach;
    const float alpha = glm::clamp(std::ceil(255 * max_component(root)), 1.0f, 255.0f);
    for (int c = 0; c < 3; ++c) {
      const float byte = std::round(std::min(1.0f, root[c] * 255 / alpha) * 255);
      out.picture.rgba.push_back(static_cast<std::uint8_t>(byte));
    }
    out.picture.rgba.push_back(static_cast<std::uint8_t>(alpha));
  }
  return out;
}

vec3 decode_rgbm(const Rgbm& rgbm, int x, int y) {
  const image::Rgba8& picture = rgbm.picture;
  require(x >= 0 && x < picture.width && y >= 0 && y < picture.height &&
              picture.rgba.size() ==
                  4 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
          "RGBM", "the picture has no such texel");
  const std::uint8_t* p = rgbm.picture.rgba.data() +
                          4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(rgbm.picture.width) +
                               static_cast<std::size_t>(x));
  const vec3 root = reach * (static_cast<float>(p[3]) / 255) * vec3(p[0], p[1], p[2]) / 255.0f;
  return rgbm.scale * root * root;
}

}  // namespace ssphh::lightmap
