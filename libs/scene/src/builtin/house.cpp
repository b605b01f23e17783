#include <ssphh/scene/sun_sky.h>

#include "house_parts.h"
#include "scenes.h"

namespace ssphh::scene {

/// A house on a plain of 250 m that is its floor, too: indoors and outdoors at once, a scene whose bounds say
/// nothing of where the light matters.
Scene make_house() {
  Builder b("house");
  const int ground = b.matte("ground", {0.35f, 0.33f, 0.28f});
  const HousePaint paint = house_paint(b);
  b.add("ground", make_quad({-125, 0, 125}, {250, 0, 0}, {0, 0, -250}), ground);
  add_house(b, paint);
  add_sun_sky(b.scene(), {.elevation = glm::radians(40.0f), .azimuth = glm::radians(-60.0f)});

  b.camera("room-a", {3.6f, 1.6f, 5}, {1, 1.1f, 0.5f}, 55);
  b.camera("room-b", {7.6f, 1.6f, 5.1f}, {5.4f, 1.1f, 0.5f}, 55);
  b.camera("room-c", {8.6f, 1.6f, 5}, {10.8f, 1, 0.8f}, 55);
  b.camera("corridor", {0.8f, 1.6f, 7}, {8, 1.2f, 6.6f}, 50);
  b.camera("outside", {22, 7, -16}, {6, 1, 4}, 40);
  return b.finish();
}

}  // namespace ssphh::scene
