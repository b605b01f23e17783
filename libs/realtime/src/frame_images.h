#pragma once
/// The images that a frame is drawn through, for one size.

#include <ssphh/gl/framebuffer.h>

namespace ssphh::realtime {

struct FrameImages {
  int width = 0, height = 0;                ///< of the picture
  int supersample = 1, indirect_scale = 1;  ///< as FrameSettings
  gl::Texture gbuffer0, gbuffer1, emitted, depth, direct, irradiance, glossy, color, resolved, occlusion;
  gl::Framebuffer geometry_pass, direct_pass, indirect_pass, compose_pass, resolve_pass, occlusion_pass;

  FrameImages() = default;
  FrameImages(int width, int height, int supersample, int indirect_scale);

  gl::Rect full() const { return {0, 0, width * supersample, height * supersample}; }
  gl::Rect indirect() const;
  gl::Rect picture() const { return {0, 0, width, height}; }
  bool fits(int w, int h, int samples, int scale) const {
    return w == width && h == height && samples == supersample && scale == indirect_scale;
  }
  /// Where the composed frame goes: straight to the picture where a pixel has one sample.
  const gl::Framebuffer& composed() const { return supersample == 1 ? resolve_pass : compose_pass; }
  std::size_t bytes() const;
};

}  // namespace ssphh::realtime
