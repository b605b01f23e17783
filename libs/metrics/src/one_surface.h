#pragma once
/// Which pixels of a picture show one smooth surface.

#include <cstdint>
#include <vector>

#include <ssphh/image/image.h>

namespace ssphh::metrics {

/// A number for each pixel, the same for pixels that are joined step by step over neighbours whose normals
/// turn by less than 10° and whose depths continue one another; 0 for pixels that are not `usable`. An empty
/// normal or depth is not looked at.
std::vector<std::uint32_t> one_surface(const std::vector<std::uint8_t>& usable, int width, int height,
                                       const image::Image& normal, const image::Image& depth);

}  // namespace ssphh::metrics
