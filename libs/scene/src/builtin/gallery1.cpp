#include "gallery_hall.h"
#include "scenes.h"

namespace ssphh::scene {

/// Colour bleeding: what the hidden lamps light directly is strongly coloured; the white bodies in the middle
/// show it.
Scene make_gallery1() {
  Builder b("gallery1");
  const int white = b.matte("white", vec3(0.78f));
  const int floor = b.matte("floor", vec3(0.6f));
  const int red = b.matte("red", {0.75f, 0.1f, 0.06f});
  const int green = b.matte("green", {0.12f, 0.55f, 0.16f});
  const int blue = b.matte("blue", {0.1f, 0.2f, 0.7f});
  const int yellow = b.matte("yellow", {0.8f, 0.62f, 0.08f});
  add_hall(b,
           {.floor = floor, .ceiling = white, .left = white, .right = white, .front = white, .back = white});

  // Lit from behind the partitions: a red panel on the back wall, a green one on the right wall.
  b.add("red panel", make_box({-4.2f, 0.3f, -3.98f}, {-0.6f, 3.7f, -3.93f}), red);
  b.add("green panel", make_box({4.93f, 0.3f, -3.6f}, {4.98f, 3.7f, 0.4f}), green);
  add_partition(b, "left partition", -3.9f, -1.5f, -2.2f, 2.3f, white);
  add_partition(b, "right partition", 1.3f, 3.7f, -1.6f, 2.3f, yellow);
  b.spot_light("red spot", {-2.7f, 0.3f, -2.6f}, {-2.5f, 2.3f, -3.95f}, {1, 0.95f, 0.9f}, 30, 35, 60, "back");
  b.spot_light("green spot", {3, 0.4f, -2.2f}, {4.95f, 2, -1.9f}, {1, 0.95f, 0.9f}, 40, 35, 60, "right");
  // The cove on the left lights a blue band of wall and the ceiling.
  b.add("blue band", make_box({-4.98f, 2.85f, -3.8f}, {-4.95f, 3.9f, 3.8f}), blue);
  add_cove(b, "cove", -1, white, {36, 35, 34}, "cove");

  // White bodies.
  float top = add_plinth(b, "plinth left", -1.6f, -0.4f, 0.7f, 0.8f, white);
  b.add("sphere", make_sphere(0.45f), white, at({-1.6f, top + 0.45f, -0.4f}));
  top = add_plinth(b, "plinth middle", 0.2f, -2.4f, 0.7f, 0.6f, white);
  b.add("cone", make_cone(0.42f, 1.1f, 64), white, at({0.2f, top, -2.4f}));
  top = add_plinth(b, "plinth right", 1.7f, -0.1f, 0.7f, 0.7f, white);
  b.add("cube", make_box({-0.3f, 0, -0.3f}, {0.3f, 0.6f, 0.3f}), white,
        at({1.7f, top, -0.1f}, 30, {0, 1, 0}));
  b.add("ball", make_sphere(0.3f), white, at({0.1f, 0.3f, 0.7f}));

  b.camera("main", {0, 1.65f, 3.8f}, {0, 1.15f, -1.5f}, 48);
  b.camera("left", {-3.2f, 1.6f, 3}, {1.5f, 1.2f, -2}, 48);
  b.sphl("front left", {-3, 1.6f, 1.6f});
  b.sphl("front right", {3, 1.6f, 1.6f});
  b.sphl("middle", {0.1f, 2, -0.6f});
  b.sphl("back left", {-2.7f, 1.7f, -3});
  b.sphl("back middle", {0.2f, 2.2f, -3.1f});
  b.sphl("back right", {3.2f, 1.7f, -2.7f});
  return b.finish();
}

}  // namespace ssphh::scene
