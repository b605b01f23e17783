#pragma once
/// An atlas in 8 bits a channel.

#include <ssphh/image/io.h>

namespace ssphh::lightmap {

/// How RGBM is read: a value is scale · (8 · alpha · colour)², as PlayCanvas decodes it with scale 1.
struct Rgbm {
  image::Rgba8 picture;
  float scale = 1;  ///< 1, or more where a value exceeds 64
};

/// Negative values become 0. A value is off by at most 1/127 of the texel's largest channel, or of 0.001 ·
/// scale where that is more. Throws Error for an image that is not whole or has other than 3 channels, and
/// for values that are not finite.
Rgbm encode_rgbm(const image::Image& linear);
/// Throws Error for a texel that there is not.
vec3 decode_rgbm(const Rgbm& rgbm, int x, int y);

}  // namespace ssphh::lightmap
