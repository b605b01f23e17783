#pragma once

#include <ssphh/core/random.h>
#include <ssphh/image/image.h>

namespace ssphh::metrics {

/// Numbers in [0, 1), independent of each other.
inline image::Image noise(int width, int height, int channels, std::uint64_t seed) {
  image::Image image(width, height, channels);
  Pcg32 random(seed);
  for (float& x : image.pixels) x = random.uniform();
  return image;
}

}  // namespace ssphh::metrics
