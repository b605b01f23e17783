#include "gallery_hall.h"
#include "scenes.h"

namespace ssphh::scene {

/// Complex objects: torus knots and spirals, lit by spots toward the ceiling, a lamp behind a partition, and
/// a cove.
Scene make_gallery3() {
  Builder b("gallery3");
  const int plaster = b.matte("plaster", {0.76f, 0.75f, 0.73f});
  const int floor = b.matte("slate", {0.35f, 0.37f, 0.4f});
  const int umber = b.matte("umber", {0.6f, 0.38f, 0.25f});
  const int violet = b.matte("violet", {0.4f, 0.25f, 0.62f});
  const int ivory = b.matte("ivory", {0.8f, 0.76f, 0.66f});
  const int coral = b.matte("coral", {0.78f, 0.35f, 0.25f});
  const int jade = b.glossy("jade", {0.15f, 0.5f, 0.33f}, 0.4f);
  const int copper = b.metal("copper", {0.9f, 0.6f, 0.48f}, 0.45f);
  add_hall(b, {.floor = floor,
               .ceiling = plaster,
               .left = umber,
               .right = violet,
               .front = plaster,
               .back = plaster});

  // Hidden lamps.
  add_cove(b, "cove", -1, plaster, {24, 23, 21}, "cove");
  add_partition(b, "partition", -1.8f, 1.8f, -2.9f, 2.4f, umber);
  b.sphere_light("globe", {0, 1.2f, -3.5f}, 0.1f, {1, 0.9f, 0.75f}, 300, "globe");
  b.spot_light("uplight left", {-3.6f, 1.95f, -2.2f}, {-3, 4, -1.6f}, {1, 0.92f, 0.8f}, 25, 30, 55,
               "uplights");
  b.spot_light("uplight right", {3.6f, 1.95f, -2.2f}, {3, 4, -1.6f}, {1, 0.92f, 0.8f}, 25, 30, 55,
               "uplights");
  b.add("stand left", make_cylinder(0.12f, 1.8f, 32), plaster, at({-3.6f, 0, -2.2f}));
  b.add("stand right", make_cylinder(0.12f, 1.8f, 32), plaster, at({3.6f, 0, -2.2f}));

  float top = add_plinth(b, "plinth middle", 0, -0.9f, 1, 0.7f, plaster);
  b.add("trefoil", make_torus_knot(2, 3, 0.42f, 0.2f, 0.1f, 512, 24), jade,
        at({0, top + 0.74f, -0.9f}, 75, {1, 0, 0}));
  top = add_plinth(b, "plinth left", -2, -0.3f, 0.8f, 0.8f, plaster);
  b.add("cinquefoil", make_torus_knot(2, 5, 0.4f, 0.17f, 0.075f, 640, 20), coral,
        at({-2, top + 0.66f, -0.3f}, 80, {1, 0.3f, 0}));
  top = add_plinth(b, "plinth right", 2, -0.3f, 0.8f, 0.8f, plaster);
  const int spiral = b.add("spiral", make_spiral(0.32f, 0.08f, 1.1f, 5, 0.045f, 480, 16), ivory,
                           at({2, top + 0.05f, -0.3f}));
  b.again("spiral on the floor", spiral, copper, at({-0.8f, 0.06f, 1}));
  b.add("fallen knot", make_torus_knot(3, 4, 0.32f, 0.13f, 0.06f, 480, 16), ivory, at({1, 0.2f, 1}));

  b.camera("main", {0, 1.65f, 3.8f}, {0, 1.15f, -1.5f}, 48);
  b.camera("detail", {1.4f, 1.7f, 2.4f}, {-0.2f, 1.2f, -1}, 45);
  b.sphl("front left", {-2.6f, 1.7f, 1.7f});
  b.sphl("front right", {2.6f, 1.7f, 1.7f});
  b.sphl("middle", {0, 2.4f, 0});
  b.sphl("back", {0.7f, 1.9f, -3.45f});
  b.sphl("left", {-3.9f, 1.5f, -0.6f});
  b.sphl("right", {3.9f, 1.5f, -0.6f});
  return b.finish();
}

}  // namespace ssphh::scene
