#pragma once
/// How far away stands what a picture shows: where a sun's shadow maps have to be fine.

#include <array>

#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/vertex_array.h>

#include "shaders.h"

namespace ssphh::realtime {

/// Depths along the view axis [m], in steps of √2, so that a view that moves a little keeps them. All 0 where
/// nothing is seen.
struct DepthSpread {
  float near = 0;  ///< one in fifty pixels may be nearer
  float most = 0;  ///< of nine in ten pixels, at most
  float far = 0;   ///< of all
};

class ViewDepths {
 public:
  ViewDepths();

  /// Of some pixels of the G-buffer that is bound; waits for the picture's geometry.
  DepthSpread measure(Shaders& shaders, const gl::VertexArray& no_vertices);

 private:
  static constexpr int width = 64, height = 36;
  gl::Texture some_;
  gl::Framebuffer target_;
  std::array<float, static_cast<std::size_t>(width* height)> depths_{};
};

}  // namespace ssphh::realtime
