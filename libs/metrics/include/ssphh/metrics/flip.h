#pragma once
/// FLIP: the difference that a person sees when flipping between two pictures, 0 (none) to 1 (the largest).
///
/// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for
/// Alternating Images (HPG 2020); Andersson, Nilsson, Shirley, Akenine-Möller: Visualizing Errors in Rendered
/// High Dynamic Range Images (Eurographics 2021). Spatial filters are applied one axis after the other, as
/// the authors' own program does since version 1.3.

#include <ssphh/image/image.h>

namespace ssphh::metrics {

struct FlipParams {
  /// How many pixels the eye sees in one degree. The authors' default: a 3840 pixel, 0.7 m wide screen 0.7 m
  /// away.
  double pixels_per_degree = 67.0206432766;
};

struct FlipError {
  image::Image map;  ///< one channel; NaN where a pixel is not finite in one of the images
  double mean = 0;   ///< over the finite pixels; 0 when there is none
  /// HDR only: exposures compared, log2 of the factor.
  double first_exposure = 0, last_exposure = 0;
  int exposures = 0;
};

/// Compares two pictures as shown on a screen: linear Rec.709 in [0, 1] (clamped). Throws Error when the
/// sizes differ or an image is empty.
FlipError flip(const image::Image& reference, const image::Image& test, const FlipParams& params = {});

/// Compares two scene-linear pictures: the largest error per pixel over the exposures, 1 stop apart or less,
/// at which a part of the reference is well exposed (its brightest pixel, then its median, at 85 % after the
/// ACES curve). A reference that is black everywhere, or in most pixels, has no such range: then the
/// exposures run over the pixels above 0, or are 0 alone.
FlipError hdr_flip(const image::Image& reference, const image::Image& test, const FlipParams& params = {});

}  // namespace ssphh::metrics
