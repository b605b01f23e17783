#include "house_parts.h"
#include "scenes.h"

namespace ssphh::scene {

/// A room whose light comes past a red door: from the corridor through the doorway, and from a lamp in the
/// wedge between the open leaf and the wall, which nothing but the red of its back reflects into the room.
Scene make_ajar() {
  Builder b("ajar");
  const float height = 2.7f, thick = 0.15f;
  const int white = b.matte("wall", vec3(0.72f));
  const int floor = b.matte("floor", {0.5f, 0.4f, 0.3f});
  const int red = b.matte("red door", {0.75f, 0.06f, 0.04f});
  const int wood = b.matte("wood", {0.45f, 0.3f, 0.18f});
  const int china = b.matte("china", {0.7f, 0.72f, 0.75f});
  // The room is x 0…5, z 0…4; the corridor behind the wall at z = 4 is 1.5 m wide.
  b.add("floor", make_box({-thick, -0.1f, -thick}, {5 + thick, 0, 5.65f + thick}), floor);
  b.add("ceiling", make_box({-thick, height, -thick}, {5 + thick, height + 0.1f, 5.65f + thick}), white);
  const auto wall = [&](const char* name, int axis, float across, float begin, float end,
                        std::vector<Opening> openings) {
    add_wall(b, name, {axis, across, begin, end, height, thick, std::move(openings)}, white);
  };
  wall("window wall", 0, -thick, -thick, 5 + thick, {});
  wall("west", 2, -thick, 0, 5.65f, {});
  wall("east", 2, 5, 0, 5.65f, {});
  wall("door wall", 0, 4, 0, 5, {{3, 3.9f, 0, 2.1f}});
  wall("corridor wall", 0, 5.65f, -thick, 5 + thick, {});
  // Hinged at x = 3.9 on the room's side, turned 150° out of the doorway: 30° are left to the wall.
  Mesh leaf = make_box({-0.88f, 0.01f, -0.04f}, {0, 2.08f, 0});
  b.add("door", std::move(leaf), red, at({3.92f, 0, 3.94f}, -150, {0, 1, 0}));

  b.sphere_light("corridor lamp", {1, 2.3f, 4.9f}, 0.08f, {1, 0.9f, 0.75f}, 150, "corridor");
  b.sphere_light("lamp behind the door", {4.45f, 1.2f, 3.86f}, 0.04f, {1, 0.95f, 0.85f}, 120, "pocket");
  add_table(b, {1.2f, 0, 1.2f}, {1.4f, 0.8f}, 0.72f, wood);
  add_teapot(b, {1.7f, 0.72f, 1.6f}, 1.2f, china);
  add_teapot(b, {2.25f, 0.72f, 1.5f}, 0.7f, red);
  b.add("ball", make_sphere(0.3f, 48, 24), china, at({3.6f, 0.3f, 0.8f}));

  b.camera("room", {0.5f, 1.6f, 0.5f}, {3.8f, 1.1f, 3.6f}, 60);
  b.camera("door", {2.4f, 1.5f, 1.3f}, {4.6f, 1.2f, 4}, 50);
  b.camera("pocket", {4.6f, 1.5f, 1.8f}, {4.8f, 1.2f, 4}, 50);
  b.camera("pots", {1.5f, 1.15f, 2.6f}, {1.95f, 0.8f, 1.5f}, 40);
  b.camera("corridor", {0.6f, 1.6f, 5.2f}, {4.8f, 1.2f, 4.8f}, 60);
  return b.finish();
}

}  // namespace ssphh::scene
