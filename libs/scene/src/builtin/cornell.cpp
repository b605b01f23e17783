#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {

/// The classical box scaled to 2 m: x −1…1, y 0…2, z −1…1, open toward +z, where the camera stands.
/// Reflectances and light: the measured spectra of Cornell's programme of computer graphics as RGB.
Scene make_cornell() {
  Builder b("cornell");
  const int white = b.matte("white", {0.725f, 0.71f, 0.68f});
  const int red = b.matte("red", {0.63f, 0.065f, 0.05f});
  const int green = b.matte("green", {0.14f, 0.45f, 0.091f});

  b.add("floor", make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), white);
  b.add("ceiling", make_quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}), white);
  b.add("back wall", make_quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}), white);
  b.add("left wall", make_quad({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}), red);
  b.add("right wall", make_quad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}), green);
  b.add("tall box", make_box({-0.3f, 0, -0.3f}, {0.3f, 1.2f, 0.3f}), white,
        at({-0.335f, 0, -0.29f}, 17, {0, 1, 0}));
  b.add("short box", make_box({-0.3f, 0, -0.3f}, {0.3f, 0.6f, 0.3f}), white,
        at({0.33f, 0, 0.375f}, -17, {0, 1, 0}));
  b.add_emitter("lamp", "lamp", make_quad({-0.24f, 1.98f, -0.22f}, {0.47f, 0, 0}, {0, 0, 0.38f}),
                {18.4f, 14, 6.75f});

  b.camera("front", {0, 1, 3.9f}, {0, 1, 0}, 39.3f, 1);
  b.sphl("center", {0, 1.3f, 0.2f});
  b.sphl("red", {-0.75f, 0.6f, 0.45f});
  b.sphl("green", {0.75f, 1.1f, -0.2f});
  b.sphl("back", {0.45f, 1.5f, -0.7f});
  b.sphl("front", {-0.1f, 0.4f, 0.8f});
  return b.finish();
}

}  // namespace ssphh::scene
