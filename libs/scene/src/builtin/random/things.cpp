#include "draw.h"

namespace ssphh::scene {

void add_thing(RandomScene& s, const vec3& foot, float size, float height) {
  Draw& draw = s.draw;
  Builder& b = s.b;
  const float r = size / 2;
  const auto above = [&](float up) { return at(foot + vec3(0, up, 0)); };
  switch (draw.pick(10)) {
    case 0: {
      const float top = std::min(height, draw.between(0.4f, 0.9f) * size);
      add_table(b, foot - vec3(r, 0, r), {size, size}, top, s.material());
      const int glaze = s.material();
      add_teapot(b, foot + vec3(0, top, 0), std::min(2 * r, draw.between(0.6f, 1.4f)), glaze);
      return;
    }
    case 1: {
      const float ball = std::min(draw.between(0.4f, 1) * r, height / 2);
      b.add("ball", make_sphere(ball, 40, 20), s.material_or_glass(), above(ball));
      return;
    }
    case 2: {
      const float around = 0.7f * r, tube = std::min(0.25f * r, height / 2);
      b.add("ring", make_torus(around, tube, 48, 20), s.material(), above(tube));
      return;
    }
    case 3: {
      const float around = std::min(0.45f * r, 0.3f * height);
      b.add("knot", make_torus_knot(2, 3, around, around / 2, around / 4, 160, 12), s.material(),
            above(0.85f * around));
      return;
    }
    case 4: {
      const float tall = draw.between(0.3f, 0.95f) * height;
      b.add("spiral", make_spiral(0.8f * r, 0.3f * r, tall, 3, 0.1f * r, 160, 12), s.material(),
            above(0.1f * r));
      return;
    }
    case 5: {
      const float tall = draw.between(0.3f, 0.95f) * height;
      b.add("cylinder", make_cylinder(0.6f * r, tall, 40), s.material_or_glass(), above(0));
      return;
    }
    case 6:
      b.add("column", make_column(0.35f * r, 0.95f * height, 40), s.material(), above(0));
      return;
    case 7: {
      const float tall = draw.between(0.4f, 0.95f) * height;
      const int wood = s.material();
      add_shelf(b, foot - vec3(r, 0, 0.3f * r), {size, tall, 0.6f * r}, 3 + draw.pick(3), wood);
      return;
    }
    case 8: {
      if (size < 2.05f) break;
      add_sofa(b, foot - vec3(1, 0, 0.45f), s.material());
      return;
    }
    default:
      break;
  }
  const float tall = draw.between(0.2f, 0.9f) * height;
  const float half_z = draw.between(0.4f, 0.7f) * r, half_x = draw.between(0.4f, 0.7f) * r;
  const vec3 half(half_x, 0, half_z);
  const float turn = draw.between(0, 90);
  b.add("block", make_box(-half, half + vec3(0, tall, 0)), s.material(), at(foot, turn, {0, 1, 0}));
}

}  // namespace ssphh::scene
