#include "draw.h"

namespace ssphh::scene {

/// Two rows of buildings on a plain, trees, lamps at night.
void add_street(RandomScene& s) {
  Draw& draw = s.draw;
  const float width = draw.between(3, 12), half = draw.scaled(60, 1500);
  s.b.add("ground", make_quad({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}), s.matte());
  const int houses = 2 + draw.pick(5);
  float length = 0;
  for (int i = 0; i < houses; ++i) {
    const float wide = draw.between(6, 15), gap = draw.chance(0.4f) ? draw.between(0.8f, 3) : 0.0f;
    for (const float side : {-1.0f, 1.0f}) {
      const float tall = draw.between(4, 18), deep = draw.between(6, 12), recess = draw.between(0, 1);
      const float near = side * (width / 2 + recess), far = side * (width / 2 + deep);
      s.b.add("house", make_box({std::min(near, far), 0, length}, {std::max(near, far), tall, length + wide}),
              s.matte());
      if (draw.chance(0.5f)) {  // a roof that juts out over the street
        const float rim = side * (width / 2 + recess - 0.8f);
        s.b.add("eaves",
                make_box({std::min(rim, far), tall, length - 0.3f},
                         {std::max(rim, far), tall + 0.3f, length + wide + 0.3f}),
                s.matte());
      }
      if (draw.chance(0.5f)) {  // an arcade
        const float rim = side * (width / 2 + recess - 1);
        s.b.add(
            "canopy",
            make_box({std::min(rim, near), 2.8f, length + 1}, {std::max(rim, near), 3, length + wide - 1}),
            s.matte());
      }
    }
    length += wide + gap;
  }
  const int trees = draw.pick(5);
  for (int i = 0; i < trees; ++i) {
    const vec3 foot((i % 2 == 0 ? -1.0f : 1.0f) * (width / 2 - 0.7f), 0,
                    length * (static_cast<float>(i) + 0.5f) / 5);
    const int leaves = s.b.matte("leaves", {0.12f, 0.3f, 0.08f});
    s.b.add("trunk", make_cylinder(0.1f, 1.8f, 16), s.b.matte("bark", {0.25f, 0.17f, 0.1f}), at(foot));
    s.b.add("crown", make_sphere(0.6f, 24, 12), leaves, at(foot + vec3(0, 2.2f, 0)));
  }
  add_thing(s, {0, 0, 0.8f * length}, 0.4f * width, 2.5f);
  const int lamps = s.daylight == Daylight::none ? 3 + draw.pick(3) : 0;
  for (int i = 0; i < lamps; ++i) {
    const vec3 place(0, 3.2f, length * (static_cast<float>(i) + 0.5f) / static_cast<float>(lamps));
    add_lamp(s, place - vec3(0.5f, 0.2f, 0.5f), place + vec3(0.5f, 0.2f, 0.5f),
             width * length / static_cast<float>(lamps));
  }
  s.b.camera("street", {0.2f, 1.7f, -4}, {0, 2.2f, length}, 60);
  s.b.camera("middle", {0.25f * width, 1.6f, 0.62f * length}, {-width / 2, 2.5f, 0.3f * length}, 65);
  s.b.camera("above", {width + 20, 30, -25}, {0, 0, length / 2}, 45);
}

}  // namespace ssphh::scene
