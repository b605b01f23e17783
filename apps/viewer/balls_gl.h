#pragma once
/// Draws the probes' balls with OpenGL into the picture.

#include <memory>

#include <ssphh/gl/texture.h>

#include "model/balls.h"
#include "model/view_camera.h"

namespace ssphh::viewer {

class BallsGl {
 public:
  BallsGl();
  ~BallsGl();
  BallsGl(const BallsGl&) = delete;
  BallsGl& operator=(const BallsGl&) = delete;

  /// New colours. Call when the set's light, or what the balls shall show, changed.
  void update(const probes::ProbeSet& set, Ball ball);

  struct Look {
    View view;
    float radius = 0;
    bool lobes = false;
    image::ToneMap tone;
    int selected = -1;
  };
  /// The frame that the balls stand in, as realtime::Renderer tells of it.
  struct Behind {
    const gl::Texture& depth;
    mat4 view_projection;
  };
  /// Draws all probes into a framebuffer that has a depth buffer of its own, the picture's lower left corner
  /// at (0, 0): behind each other they are hidden, behind the frame's surfaces faint.
  void draw(const probes::ProbeSet& set, const Look& look, const Behind& frame, unsigned framebuffer,
            int width, int height);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace ssphh::viewer
