#pragma once
/// What an engine has drawn, for Renderer::draw_indirect().

#include <ssphh/core/math.h>

namespace ssphh::realtime {

/// OpenGL's numbers of the engine's own 2-D textures, all of one size, one sample a texel, and how they are
/// read. World: right-handed, y up, metres, as the scene's.
struct GBuffer {
  unsigned depth = 0;  ///< window depth in its first channel, any format; asked where there is no `position`
  unsigned position = 0;  ///< place of the world that the texel's middle shows; alpha 0: nothing stands there
  unsigned normal = 0;    ///< that shades, of the world, of any length
  unsigned geometric_normal = 0;  ///< of the plane that was drawn, likewise: sight of probes is taken from
                                  ///< off it; 0: `normal` is
  bool normal_from_zero = false;  ///< both are stored as 0.5 + 0.5 n
  unsigned albedo = 0;            ///< linear, 0..1; 0: a white surface everywhere
  unsigned moving = 0;            ///< first channel above 0.5: on what moves; 0: all stands still
  mat4 view_projection{1};   ///< world to clip space, as it was drawn with: a perspective or orthographic
                             ///< camera, also off its axis or moved by parts of a pixel
  bool zero_to_one = false;  ///< clip space has z in 0..w (glClipControl) in place of -w..w
  float empty_depth = 1;     ///< where nothing was drawn: 0 where depth is reversed
};

}  // namespace ssphh::realtime
