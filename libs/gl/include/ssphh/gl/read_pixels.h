#pragma once

#include <cstdint>
#include <vector>

#include <ssphh/gl/framebuffer.h>

namespace ssphh::gl {

/// Colours of a part of a framebuffer (0: the window's own, before it is shown) as RGBA bytes with alpha 255,
/// the uppermost row first. Waits for what is being drawn.
std::vector<std::uint8_t> read_pixels(unsigned framebuffer, const Rect& part);

}  // namespace ssphh::gl
