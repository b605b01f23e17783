#pragma once
/// Draws the probes' balls with OpenGL into the picture.

#include <memory>

#include <ssphh/scene/query.h>

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
  void update(const gi::ProbeSet& set, Ball ball);

  struct Look {
    View view;
    float radius = 0.1f;
    bool lobes = false;
    image::ToneMap tone;
    int selected = -1;
  };
  /// Draws the probes for which visible[i] is not 0 into a framebuffer that has a depth buffer, the picture's
  /// lower left corner at (0, 0); hides them behind each other only.
  void draw(const gi::ProbeSet& set, const std::vector<unsigned char>& visible, const Look& look,
            unsigned framebuffer, int width, int height);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace ssphh::viewer
