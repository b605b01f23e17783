#pragma once
/// The mean of pictures with OpenGL, each of the same view moved by another part of a pixel: edges without
/// steps.

#include <memory>

#include <ssphh/core/math.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/texture.h>

namespace ssphh::viewer {

class AverageGl {
 public:
  AverageGl();
  ~AverageGl();
  AverageGl(const AverageGl&) = delete;
  AverageGl& operator=(const AverageGl&) = delete;

  /// Forgets all pictures.
  void clear() { count_ = 0; }
  int count() const { return count_; }
  /// One more, 8 bits by the sRGB curve: the mean is that of the light on the screen. All since clear() are
  /// of one size.
  void add(const gl::Texture& picture);
  /// Of all since clear(), at least one; encoded as they are.
  const gl::Texture& mean() const;
  /// mean(), and forgets all pictures.
  gl::Texture take();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
  int count_ = 0;
};

/// Where the i-th picture of a mean stands, as realtime::FrameSettings::shift: the first one at its own
/// place, all spread evenly over a pixel about it.
vec2 place_in_pixel(int i);

}  // namespace ssphh::viewer
