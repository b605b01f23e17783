#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/builtin.h>

#include "gl_context.h"

namespace ssphh {
namespace {

using realtime::Renderer;
using ReadSome = test::WithGl;

TEST_F(ReadSome, SomePixelsAreReadThatTheWholePictureHas) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  Renderer renderer(gl(), scene);
  EXPECT_THROW(renderer.read_some(4, 4), Error) << "no frame yet";
  for (const int samples : {1, 2}) {
    renderer.draw(scene::camera_pose(scene, ""), {.supersample = samples}, {.width = 64, .height = 36});
    const image::Image all = renderer.read_back(), some = renderer.read_some(21, 12);
    EXPECT_EQ(some.width, 21);
    EXPECT_EQ(some.height, 12);
    for (int y = 0; y < some.height; ++y) {
      for (int x = 0; x < some.width; ++x) {
        bool found = false;  // within a pixel of the middle of its area
        for (int i = 0; i < 9; ++i) {
          const int at_x = std::min((2 * x + 1) * 64 / 42 - 1 + i % 3, 63),
                    at_y = std::min((2 * y + 1) * 36 / 24 - 1 + i / 3, 35);
          found |= all.rgb(at_x, at_y) == some.rgb(x, y);
        }
        EXPECT_TRUE(found) << x << ", " << y;
      }
    }
    EXPECT_EQ(renderer.read_some(64, 36).pixels, all.pixels);
    EXPECT_EQ(renderer.read_some(500, 36).pixels, all.pixels) << "there are no more";
    EXPECT_EQ(renderer.read_some(500, 2).width, 64);
    EXPECT_THROW(renderer.read_some(0, 4), Error);
  }
}

}  // namespace
}  // namespace ssphh
