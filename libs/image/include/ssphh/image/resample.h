#pragma once
/// Flat images in another size.

#include <ssphh/image/image.h>

namespace ssphh::image {

/// `box`: exact means over the area of the new pixels; keeps the image's mean exactly and never overshoots.
/// `bilinear`: triangle, widened when the image shrinks. `mitchell`: Mitchell and Netravali 1988, B = C =
/// 1/3. `lanczos`: windowed sinc of 3 lobes, the sharpest; both overshoot at edges, down to negative values.
enum class Filter { box, bilinear, mitchell, lanczos };

/// Separable; weights of each new pixel sum to 1, so constants stay, and the edge pixels are repeated
/// outside. Any number of channels; throws Error for an empty image or a size below 1.
Image resize(const Image& image, int width, int height, Filter filter = Filter::box);

/// Bilinear between pixel centres at (x + 0.5, y + 0.5); places outside give the edge's colour.
vec3 sample_bilinear(const Image& image, float x, float y);

}  // namespace ssphh::image
