#pragma once
/// Real-time picture and ground truth side by side, as 8-bit pictures for the screen.

#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/metrics/compare.h>

#include "settings.h"

namespace ssphh::viewer {

struct Difference {
  image::Rgba8 picture;
  float scale = 0;  ///< what the last colour stands for
  metrics::ImageError error;
};

/// For Show::absolute, signed_ and pixelated; `block` pixels. Both images linear, of one size, else Error.
Difference difference(const image::Image& truth, const image::Image& realtime, Show show, int block);

/// Looked-up indirect light where path tracing finds next to none: under a thousandth of its mean over the
/// picture. All images linear and of one size, indirect radiance only.
Difference leak_picture(const image::Image& truth_indirect, const image::Image& realtime_indirect);

}  // namespace ssphh::viewer
