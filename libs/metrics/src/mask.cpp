#include <limits>

#include <ssphh/metrics/mask.h>

namespace ssphh::metrics {

bool in_mask(const image::Image& mask, int x, int y, int width, int height) {
  image::require_whole(mask, "mask");
  require(x >= 0 && y >= 0 && x < width && y < height, "mask", "the pixel does not lie in the picture");
  const auto nearest = [](int at, int size, int of) {
    return static_cast<int>((static_cast<std::int64_t>(2 * at + 1) * of) /
                            (2 * static_cast<std::int64_t>(size)));
  };
  const vec3 c = mask.rgb(nearest(x, width, mask.width), nearest(y, height, mask.height));
  return (c.x + c.y + c.z) / 3 >= 0.5f;
}

image::Image masked(const image::Image& picture, const image::Image& mask) {
  image::require_whole(picture, "masked picture");
  image::Image result = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (in_mask(mask, x, y, picture.width, picture.height)) continue;
      for (int c = 0; c < picture.channels; ++c) result.at(x, y)[c] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return result;
}

std::uint64_t pixels_outside(const image::Image& mask, int width, int height) {
  std::uint64_t count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) count += !in_mask(mask, x, y, width, height);
  return count;
}

}  // namespace ssphh::metrics
