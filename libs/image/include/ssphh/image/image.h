#pragma once
/// Float images: scene-linear Rec.709, row 0 on top.

#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/core/require.h>

namespace ssphh::image {

/// width × height × channels floats, interleaved, row-major from the top left. channels is 1 (scalar), 3
/// (RGB) or 4 (RGB and alpha, not premultiplied). Access to pixels is unchecked, as that to a vector's
/// elements.
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<float> pixels;

  Image() = default;
  /// All zero. Throws Error for a negative size or no channel.
  Image(int width_, int height_, int channels_ = 3) : width(width_), height(height_), channels(channels_) {
    require(width >= 0 && height >= 0 && channels >= 1, "image", "its size must not be negative");
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                  static_cast<std::size_t>(channels));
  }

  bool empty() const { return pixels.empty(); }
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
  float* at(int x, int y) { return pixels.data() + offset(x, y); }
  const float* at(int x, int y) const { return pixels.data() + offset(x, y); }

  /// Colour of a pixel; a one-channel image gives the same value three times.
  vec3 rgb(int x, int y) const {
    const float* p = at(x, y);
    return channels == 1 ? vec3(p[0]) : vec3(p[0], p[1], p[2]);
  }
  /// Only for 3 or 4 channels.
  void set_rgb(int x, int y, const vec3& c) {
    float* p = at(x, y);
    p[0] = c.x, p[1] = c.y, p[2] = c.z;
  }
};

/// Throws Error unless the image has pixels, as many as its size says, and 1, 3 or 4 channels.
void require_whole(const Image& image, const char* where);

}  // namespace ssphh::image
