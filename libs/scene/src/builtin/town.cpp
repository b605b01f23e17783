#include <cmath>

#include <ssphh/scene/sun_sky.h>

#include "house_parts.h"
#include "scenes.h"

namespace ssphh::scene {

/// The same house again and again in rows along streets, each turned by quarters: for what grows with a
/// scene's extent.
Scene make_town(int houses) {
  Builder b("town");
  const float lot = 24;
  const auto columns = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(houses))));
  const float half = lot * static_cast<float>(columns) / 2 + 125;
  const int ground = b.matte("ground", {0.35f, 0.33f, 0.28f});
  const HousePaint paint = house_paint(b);
  b.add("ground", make_quad({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}), ground);
  const auto place = [&](int house) {
    const auto column = static_cast<float>(house % columns), row = static_cast<float>(house / columns);
    return lot * (vec3(column, 0, row) + vec3(0.5f, 0, 0.5f)) - vec3(half - 125, 0, half - 125);
  };
  for (int i = 0; i < houses; ++i) {
    const quat turned = glm::angleAxis(static_cast<float>(i % 4) * pi / 2, vec3(0, 1, 0));
    const vec3 middle(6.1f, 0, 4.1f);
    b.stand_on(b.node("house", {place(i) - turned * middle, turned, vec3(1)}));
    add_house(b, paint);
    b.stand_on(-1);
  }
  add_sun_sky(b.scene(), {.elevation = glm::radians(40.0f), .azimuth = glm::radians(-60.0f)});

  // The first house is not turned: the cameras of `house`, moved.
  const vec3 first = place(0) - vec3(6.1f, 0, 4.1f);
  b.camera("room", first + vec3(3.6f, 1.6f, 5), first + vec3(1, 1.1f, 0.5f), 55);
  b.camera("corridor", first + vec3(0.8f, 1.6f, 7), first + vec3(8, 1.2f, 6.6f), 50);
  b.camera("street", first + vec3(-3.5f, 1.7f, -8), first + vec3(6, 1.5f, 12), 55);
  b.camera("above", vec3(half - 125 + 20, 22, -half + 125 - 20), vec3(0), 45);
  return b.finish();
}

}  // namespace ssphh::scene
