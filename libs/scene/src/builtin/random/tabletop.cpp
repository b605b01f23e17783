#include "draw.h"

namespace ssphh::scene {

/// Things side by side on a plate before a backdrop, as a product's picture has them.
void add_tabletop(RandomScene& s) {
  Draw& draw = s.draw;
  const int across = 1 + draw.pick(4), deep = 1 + draw.pick(2);
  const float step = 1.2f, half_x = step * static_cast<float>(across) / 2 + 1;
  const float half_z = step * static_cast<float>(deep) / 2 + 1;
  const float plate = draw.chance(0.4f) ? draw.scaled(half_x, 300) : half_x + 0.5f;
  s.b.add("plate", make_quad({-plate, 0, plate}, {2 * plate, 0, 0}, {0, 0, -2 * plate}), s.matte());
  if (draw.chance(0.6f))
    s.b.add("backdrop", make_box({-half_x, 0, -half_z - 0.1f}, {half_x, 2.5f, -half_z}), s.matte());
  if (draw.chance(0.4f))
    s.b.add("side", make_box({-half_x - 0.1f, 0, -half_z}, {-half_x, 2.5f, half_z}), s.matte());
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < deep; ++j) {
      const vec3 foot(step * (static_cast<float>(i) + 0.5f) - half_x + 1, 0,
                      step * (static_cast<float>(j) + 0.5f) - half_z + 1);
      add_thing(s, foot, draw.between(0.5f, 0.95f), 1.2f);
    }
  }
  const int lamps = s.daylight == Daylight::none ? 1 + draw.pick(3) : draw.pick(2);
  for (int i = 0; i < lamps; ++i)
    add_lamp(s, {-half_x, 2, 0}, {half_x, 3, half_z + 1}, 4 * half_x * half_z / static_cast<float>(lamps));
  s.b.camera("front", {0.4f, 1.6f, half_z + 2.5f}, {0, 0.5f, 0}, 45);
  s.b.camera("near", {half_x + 1.2f, 0.9f, half_z + 0.6f}, {0, 0.4f, 0}, 40);
}

}  // namespace ssphh::scene
