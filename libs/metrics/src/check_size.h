#pragma once

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/image/image.h>

namespace ssphh::metrics {

inline void check_same_size(const image::Image& reference, const image::Image& test) {
  if (reference.empty() || test.empty()) throw Error("compare", "an image is empty");
  image::require_whole(reference, "compare");
  image::require_whole(test, "compare");
  if (reference.width != test.width || reference.height != test.height) {
    throw Error("compare", fmt::format("sizes differ: reference {} x {}, test {} x {}", reference.width,
                                       reference.height, test.width, test.height));
  }
}

}  // namespace ssphh::metrics
