/// Walls of pieces that abut: no pixel slips between them and shows what is within.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>

#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

using Cracks = test::WithGl;

// One pixel of this wall did, where pieces meet above a window's corner.
TEST_F(Cracks, ShowNothingOfTheInside) {
  const scene::Scene scene = scene::make_builtin("random?seed=88");
  realtime::Renderer renderer(gl(), scene, test::small_maps);
  realtime::FrameSettings settings;
  settings.view = realtime::View::normal;
  renderer.draw(scene::camera_pose(scene, "outside"), settings, {.width = 960, .height = 540});
  const image::Image normals = renderer.read_back();
  int other = 0;
  for (int y = 196; y < 212; ++y) {
    for (int x = 572; x < 602; ++x)
      other += glm::distance(normals.rgb(x, y), normals.rgb(570, 200)) > 0.01f ? 1 : 0;
  }
  EXPECT_EQ(other, 0);
}

}  // namespace
}  // namespace ssphh
