#include <ssphh/scene/sun_sky.h>

#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {

/// A road tunnel, open at both ends, with a lamp every 30 m: long, thin, and dark between the lamps.
Scene make_tunnel() {
  Builder b("tunnel");
  const float length = 870, half = 3, height = 4, thick = 0.3f;
  const int road = b.matte("road", vec3(0.25f));
  const int wall = b.matte("wall", {0.7f, 0.7f, 0.68f});
  const int rock = b.matte("rock", {0.4f, 0.36f, 0.3f});
  const int red = b.matte("red", {0.7f, 0.15f, 0.1f});
  const int blue = b.matte("blue", {0.1f, 0.2f, 0.6f});
  b.add("ground", make_quad({-40, 0, length + 40}, {80, 0, 0}, {0, 0, -length - 80}), rock);
  b.add("road", make_box({-half, 0, -40}, {half, 0.02f, length + 40}), road);
  b.add("left wall", make_box({-half - thick, 0, 0}, {-half, height, length}), wall);
  b.add("right wall", make_box({half, 0, 0}, {half + thick, height, length}), wall);
  b.add("roof", make_box({-half - thick, height, 0}, {half + thick, height + thick, length}), wall);
  for (int i = 0; i < 29; ++i) {
    const float z = 15 + 30 * static_cast<float>(i);
    b.add_emitter("lamp", "lamps",
                  make_box({-0.5f, height - 0.15f, z - 0.5f}, {0.5f, height - 0.05f, z + 0.5f}),
                  vec3(20, 17, 12));
  }
  for (int i = 0; i < 20; ++i) {
    const float z = 20 + 42 * static_cast<float>(i), side = i % 2 == 0 ? 1.2f : -2.8f;
    b.add("car", make_box({side, 0.3f, z}, {side + 1.6f, 1.3f, z + 4}), i % 3 == 0 ? blue : red);
  }
  add_sun_sky(b.scene(), {.elevation = glm::radians(50.0f), .azimuth = glm::radians(-30.0f)});

  b.camera("middle", {0, 1.6f, 400}, {0.3f, 1.3f, 440}, 60);
  b.camera("between-lamps", {-2.4f, 1.5f, 178}, {2.5f, 1, 186}, 60);
  b.camera("mouth", {0.8f, 1.6f, 25}, {0, 1.4f, -20}, 60);
  b.camera("outside", {8, 4, -25}, {0, 2, 10}, 50);
  return b.finish();
}

}  // namespace ssphh::scene
