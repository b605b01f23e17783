#include <cmath>

#include "draw.h"

namespace ssphh::scene {

/// One large room with columns, stairs to a gallery, high windows or lamps.
void add_hall(RandomScene& s) {
  Draw& draw = s.draw;
  const float half_x = draw.between(4, 18), half_z = draw.between(4, 10), height = draw.between(4, 9);
  const float thick = 0.4f;
  const bool day = s.daylight != Daylight::none;
  const int walls = s.matte(), pane = day ? s.pane() : -1;
  s.b.add("floor", make_box({-half_x - thick, -0.3f, -half_z - thick}, {half_x + thick, 0, half_z + thick}),
          s.checkered(half_x));
  s.b.add(
      "ceiling",
      make_box({-half_x - thick, height, -half_z - thick}, {half_x + thick, height + 0.3f, half_z + thick}),
      s.matte());
  const auto openings = [&](float half) {
    std::vector<Opening> result;
    if (!day) return result;
    for (float at = -half + 1; at + 1.5f < half; at += 3)
      result.push_back({at, at + 1.2f, 0.45f * height, 0.85f * height, pane});
    return result;
  };
  const auto wall = [&](int axis, float across, float half, std::vector<Opening> holes) {
    add_wall(s.b, "wall", {axis, across, -half, half, height, thick, std::move(holes)}, walls);
  };
  wall(0, -half_z - thick, half_x + thick, openings(half_x));
  wall(0, half_z, half_x + thick, draw.chance(0.5f) ? openings(half_x) : std::vector<Opening>{});
  wall(2, -half_x - thick, half_z, {});
  wall(2, half_x, half_z, draw.chance(0.5f) ? openings(half_z) : std::vector<Opening>{});

  // A gallery along one side, on columns, with stairs.
  const float level = 0.17f * std::floor(0.45f * height / 0.17f), edge = half_z - draw.between(1.5f, 2.5f);
  const int stone = s.matte();
  s.b.add("gallery", make_box({-half_x, level - 0.2f, edge}, {half_x, level, half_z}), stone);
  s.b.add("parapet", make_box({-half_x + 2.2f, level, edge}, {half_x, level + 0.9f, edge + 0.08f}), stone);
  const int steps = static_cast<int>(level / 0.17f);
  if (static_cast<float>(steps) * 0.28f < edge + half_z - 0.5f) {
    // Up to the gallery's left end, whose parapet leaves 2.2 m free.
    s.b.stand_on(s.b.node("stairs",
                          at({-half_x + 0.3f, 0, edge - static_cast<float>(steps) * 0.28f}, -90, {0, 1, 0})));
    add_stairs(s.b, {0, 0, -1.4f}, steps, 1.4f, stone);
    s.b.stand_on(-1);
  }
  const Mesh column = make_column(0.22f, level - 0.2f, 40);
  for (float x = -half_x + 2; x < half_x - 0.5f; x += 3)
    s.b.add("column", column, stone, at({x, 0, edge + 0.3f}));

  const int things = 1 + draw.pick(6);
  for (int i = 0; i < things; ++i) {
    const float x =
        -half_x + 2.6f + (2 * half_x - 4) * (static_cast<float>(i) + 0.3f) / static_cast<float>(things);
    add_thing(s, {x, 0, -half_z + 2.4f}, draw.between(0.6f, 1.6f), 0.5f * height);
  }
  const int lamps = day ? draw.pick(2) : 2 + draw.pick(3);
  for (int i = 0; i < lamps; ++i) {
    const float x = half_x * (2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(lamps) - 1);
    add_lamp(s, {x - 0.2f, 0.55f * height, -1}, {x + 0.2f, 0.9f * height, 0.5f},
             4 * half_x * half_z / static_cast<float>(lamps));
  }
  s.b.camera("hall", {half_x - 0.8f, 1.7f, 0.3f}, {-half_x, 0.3f * height, 0}, 65);
  s.b.camera("under-the-gallery", {half_x - 1, 1.5f, edge + 0.9f}, {-half_x, 1.2f, edge - 0.4f}, 60);
  s.b.camera("gallery", {half_x - 0.7f, level + 1.4f, half_z - 0.6f}, {-half_x, 0.4f * height, -half_z}, 65);
}

}  // namespace ssphh::scene
