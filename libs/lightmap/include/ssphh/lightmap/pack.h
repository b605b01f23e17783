#pragma once
/// Rectangles side by side in a larger one.

#include <optional>
#include <span>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::lightmap {

struct Packing {
  std::vector<glm::ivec2> at;  ///< least corner of each rectangle
  int height = 0;              ///< up to which they reach
};

/// Places rectangles without overlap in a strip of that width and at most that height, each as low as the
/// ones before it let it lie, the highest first (bottom-left skyline: Jylänki, A Thousand Ways to Pack the
/// Bin, 2010). None where they do not fit. Throws Error for
/// a size of 0 or less.
std::optional<Packing> pack(std::span<const glm::ivec2> sizes, int width, int height);

}  // namespace ssphh::lightmap
