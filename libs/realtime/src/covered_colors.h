#pragma once
/// Colours of textures whose alpha is coverage.

#include <cstdint>
#include <vector>

#include <ssphh/scene/scene.h>

namespace ssphh::realtime {

/// A texture's RGBA in which what covers nothing has the colour of what is around it, by coverage (pull-push:
/// Gortler et al., The Lumigraph, 1996): filters and smaller pictures, which average colours and coverage
/// apart, do not take on the hue of what is cut away. All else is as it was, and all of a texture that covers
/// nothing.
std::vector<std::uint8_t> covered_colors(const scene::Texture& texture);

}  // namespace ssphh::realtime
