#pragma once
/// Where stands what a picture shows: there a sun's shadow maps have to be fine.

#include <array>
#include <span>

#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/vertex_array.h>

#include "shaders.h"

namespace ssphh::realtime {

/// Depths along the view axis [m] in steps of √2, so that a view that moves a little keeps them; all 0 where
/// nothing is seen.
struct Seen {
  float near = 0;                ///< one in fifty pixels may be nearer
  float most = 0;                ///< of nine in ten pixels, at most
  float far = 0;                 ///< of all
  std::span<const vec4> places;  ///< of pixels that are spread evenly [m]; w: depth
};

class SeenPlaces {
 public:
  /// Pixels asked, across and down.
  static constexpr int width = 64, height = 36;

  SeenPlaces();

  /// Of the G-buffer that is bound; waits for the picture's geometry. The result is good until the next call.
  Seen measure(Shaders& shaders, const gl::VertexArray& no_vertices);

 private:
  static constexpr auto count = static_cast<std::size_t>(width * height);
  gl::Texture some_;
  gl::Framebuffer target_;
  std::array<vec4, count> places_{};
  std::array<float, count> depths_{};
};

}  // namespace ssphh::realtime
