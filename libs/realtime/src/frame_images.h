#pragma once
/// The images that a frame is drawn through, for one size.

#include <ssphh/gl/buffer.h>
#include <ssphh/gl/framebuffer.h>

namespace ssphh::realtime {

struct FrameImages {
  int width = 0, height = 0;                ///< of the picture
  int supersample = 1, indirect_scale = 1;  ///< as FrameSettings
  gl::Texture gbuffer0, gbuffer1, depth, occlusion, shadow;
  gl::Texture irradiance, glossy, cells;        ///< with `listed`, for an indirect_scale above 1 alone
  gl::Texture color;                            ///< radiance of every sample
  gl::Buffer listed;                            ///< ListHead, and room for every sample
  gl::Texture resolved;                         ///< of every pixel, where a pixel has several samples
  gl::Texture exits, exit_depth, behind_glass;  ///< for bodies of glass alone
  gl::Framebuffer exits_pass, bent_pass;
  /// For rough sheets alone: the picture behind them, how far away it is, and what all glass leaves of it.
  gl::Texture behind_frost, behind_gbuffer1, left_by_glass;
  gl::Framebuffer left_by_glass_pass;
  gl::Framebuffer geometry_pass, light_pass, glass_pass, indirect_pass, cells_pass, occlusion_pass,
      shadow_pass, resolve_pass;

  FrameImages() = default;
  FrameImages(int width, int height, int supersample, int indirect_scale);

  gl::Rect full() const { return {0, 0, width * supersample, height * supersample}; }
  gl::Rect indirect() const;
  gl::Rect picture() const { return {0, 0, width, height}; }
  const gl::Texture& result() const { return supersample == 1 ? color : resolved; }
  bool fits(int w, int h, int samples, int scale) const {
    return w == width && h == height && samples == supersample && scale == indirect_scale;
  }
  std::size_t bytes() const;
  /// Makes what bodies of glass need, where it is not there yet.
  void want_bodies();
  /// Likewise for rough sheets.
  void want_frost();

 private:
  void make_interpolation();
};

}  // namespace ssphh::realtime
