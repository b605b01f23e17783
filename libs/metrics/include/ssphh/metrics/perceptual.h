#pragma once
/// Similarity of two pictures as shown on a screen. The images are scene-linear Rec.709; both are clamped to
/// [0, 1] and encoded with the sRGB curve first, so expose them to taste before. Pixels that are not finite
/// in either image are left out.

#include <ssphh/image/image.h>

namespace ssphh::metrics {

struct DisplayError {
  double psnr = 0;  ///< −10·log10 of the mean squared difference of the encoded channels, dB; ∞ when equal
  /// Structural similarity of the encoded luma, 1 when equal: Wang, Bovik, Sheikh, Simoncelli, Image Quality
  /// Assessment: From Error Visibility to Structural Similarity (2004): Gaussian window of 11×11 pixels,
  /// σ = 1.5, K₁ = 0.01, K₂ = 0.03; the mean over all windows that lie inside the image, or over one window
  /// of the image's size where it is smaller. 1 when no window is finite.
  double ssim = 0;
};

/// Throws Error when the sizes differ or an image is empty.
DisplayError display_error(const image::Image& reference, const image::Image& test);

}  // namespace ssphh::metrics
