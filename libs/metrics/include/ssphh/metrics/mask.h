#pragma once
/// Parts of a picture that are measured by themselves, given as a second picture.

#include <cstdint>

#include <ssphh/image/image.h>

namespace ssphh::metrics {

/// Whether pixel (x, y) of a picture of width × height lies in the mask, which may have another size: the
/// mean of the colour channels of the mask's nearest pixel is at least one half (linear; alpha is not looked
/// at).
bool in_mask(const image::Image& mask, int x, int y, int width, int height);

/// The picture with NaN outside the mask, which every error of this module leaves out.
image::Image masked(const image::Image& picture, const image::Image& mask);

/// Pixels of width × height outside the mask.
std::uint64_t pixels_outside(const image::Image& mask, int width, int height);

}  // namespace ssphh::metrics
