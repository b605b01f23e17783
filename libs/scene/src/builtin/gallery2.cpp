#include "gallery_hall.h"
#include "scenes.h"

namespace ssphh::scene {

/// Several objects: columns, spheres, boxes and tori on plinths, most of them matte; a sphere lamp behind a
/// partition and a cove are the only light.
Scene make_gallery2() {
  Builder b("gallery2");
  const int plaster = b.matte("plaster", {0.75f, 0.72f, 0.66f});
  const int floor = b.matte("terracotta", {0.55f, 0.36f, 0.27f});
  const int ochre = b.matte("ochre", {0.7f, 0.48f, 0.2f});
  const int teal = b.matte("teal", {0.12f, 0.45f, 0.45f});
  const int stone = b.matte("stone", {0.68f, 0.66f, 0.62f});
  const int rose = b.matte("rose", {0.7f, 0.3f, 0.32f});
  const int glaze = b.glossy("glaze", {0.15f, 0.25f, 0.55f}, 0.45f);
  const int bronze = b.metal("bronze", {0.72f, 0.5f, 0.3f}, 0.5f);
  add_hall(
      b,
      {.floor = floor, .ceiling = plaster, .left = ochre, .right = plaster, .front = plaster, .back = teal});

  // Hidden lamps: a cove on the right wall, a sphere and an uplight behind the partition.
  add_cove(b, "cove", 1, plaster, {36, 33, 29}, "cove");
  add_partition(b, "partition", -2.2f, 2.2f, -2.4f, 2.2f, plaster);
  b.sphere_light("globe", {-1.2f, 1.1f, -3.3f}, 0.12f, {1, 0.85f, 0.65f}, 280, "globe");
  b.spot_light("uplight", {1.3f, 0.3f, -2.9f}, {1.2f, 4, -3.4f}, {0.85f, 0.92f, 1}, 40, 30, 55, "uplight");

  const Mesh column = make_column(0.25f, 4, 48);
  const int shaft = b.add("column 1", column, stone, at({-3.3f, 0, 0.6f}));
  b.again("column 2", shaft, stone, at({3.3f, 0, 0.6f}));
  b.again("column 3", shaft, stone, at({-3.3f, 0, -2}));
  b.again("column 4", shaft, stone, at({3.3f, 0, -2}));

  float top = add_plinth(b, "plinth 1", -1.7f, -0.6f, 0.7f, 0.9f, plaster);
  b.add("torus", make_torus(0.34f, 0.13f), rose, at({-1.7f, top + 0.47f, -0.6f}, 80, {1, 0.2f, 0}));
  top = add_plinth(b, "plinth 2", 0, -1.3f, 0.8f, 0.6f, plaster);
  b.add("glazed sphere", make_sphere(0.5f), glaze, at({0, top + 0.5f, -1.3f}));
  top = add_plinth(b, "plinth 3", 1.7f, -0.6f, 0.7f, 0.9f, plaster);
  b.add("box", make_box({-0.25f, 0, -0.25f}, {0.25f, 0.7f, 0.25f}), stone,
        at({1.7f, top, -0.6f}, 35, {0, 1, 0}));
  b.add("ball", make_sphere(0.28f), rose, at({0.9f, 0.28f, 0.7f}));
  b.add("ring", make_torus(0.4f, 0.12f), bronze, at({-0.8f, 0.12f, 0.8f}));
  b.add("bench", make_box({-1, 0, -0.2f}, {1, 0.42f, 0.2f}), ochre, at({4.2f, 0, -0.7f}, 90, {0, 1, 0}));

  b.camera("main", {0, 1.65f, 3.8f}, {0, 1.15f, -1.5f}, 48);
  b.camera("right", {4.2f, 1.7f, 2.6f}, {-0.8f, 1, -1}, 48);
  b.sphl("front left", {-2, 1.8f, 1.8f});
  b.sphl("front right", {2, 1.8f, 1.8f});
  b.sphl("middle", {0, 2, -0.2f});
  b.sphl("back", {0.1f, 2.1f, -3.2f});
  b.sphl("aisle left", {-4.2f, 1.6f, -1});
  b.sphl("aisle right", {4.2f, 1.6f, -1.8f});
  return b.finish();
}

}  // namespace ssphh::scene
