#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw.h"

namespace ssphh::scene {
namespace {

constexpr float thick = 0.2f, doorway_width = 0.9f, doorway_height = 2.05f;

/// An opening of `wide` somewhere on a wall that goes from `from` to `to`.
Opening somewhere(Draw& draw, float from, float to, float wide, float low, float high, int pane = -1) {
  const float begin = draw.between(from + 0.3f, std::max(from + 0.3f, to - wide - 0.3f));
  return {begin, std::min(begin + wide, to - 0.1f), low, high, pane};
}

/// A leaf in a doorway, turned by any angle.
void add_leaf(RandomScene& s, int axis, float across, const Opening& door) {
  const float wide = door.to - door.from - 0.02f;
  Mesh leaf = make_box({0.01f, 0.01f, -0.02f}, {wide, doorway_height - 0.02f, 0.02f});
  const float angle = s.draw.between(0, 110) + (axis == 0 ? 0.0f : -90.0f);
  vec3 hinge(across + thick / 2, 0, across + thick / 2);
  hinge[axis] = door.from;
  s.b.add("door", std::move(leaf), s.matte(), at(hinge, angle, {0, 1, 0}));
}

}  // namespace

/// Rooms in a row or a square, with doorways, doors, windows where there is daylight, furniture along the
/// walls, and their middles free.
void add_flat(RandomScene& s) {
  Draw& draw = s.draw;
  const int columns = 1 + draw.pick(3), rows = 1 + draw.pick(2);
  const float height = draw.between(2.3f, 3.4f);
  std::vector<float> xs{0}, zs{0};
  for (int i = 0; i < columns; ++i) xs.push_back(xs.back() + draw.between(2.6f, 6) + thick);
  for (int i = 0; i < rows; ++i) zs.push_back(zs.back() + draw.between(2.6f, 5) + thick);
  const float wide = xs.back() + thick, deep = zs.back() + thick;
  const bool day = s.daylight != Daylight::none;
  const int outer = s.matte(), pane = day ? s.pane() : -1;

  if (day && draw.chance(0.5f)) {
    const float half = draw.scaled(15, 600);
    s.b.add("ground", make_quad({-half, 0, half + deep}, {2 * half + wide, 0, 0}, {0, 0, -2 * half - deep}),
            s.matte());
  } else {
    s.b.add("floor", make_box({0, -0.2f, 0}, {wide, 0, deep}),
            draw.chance(0.5f) ? s.checkered(wide) : s.matte());
  }
  s.b.add("ceiling", make_box({0, height, 0}, {wide, height + 0.2f, deep}), outer);

  const auto wall = [&](int axis, float across, float begin, float end, std::vector<Opening> openings,
                        int material) {
    add_wall(s.b, "wall", {axis, across, begin, end, height, thick, std::move(openings)}, material);
  };
  const auto window = [&](float from, float to) {
    std::vector<Opening> openings;
    if (day && draw.chance(0.7f)) {
      const float sill = draw.between(0, 1.1f), width = draw.between(0.8f, 2.2f);
      openings.push_back(somewhere(draw, from, to, width, sill, 2.1f, pane));
    }
    return openings;
  };
  for (int row = 0; row <= rows; ++row) {
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      const float from = xs[i] + thick, to = xs[i + 1];
      const float across = zs[row];
      if (row == 0 || row == rows) {
        wall(0, across, xs[i], to, window(from, to), outer);
        continue;
      }
      const Opening door = somewhere(draw, from, to, doorway_width, 0, doorway_height);
      wall(0, across, xs[i], to, {door}, s.matte());
      if (draw.chance(0.6f)) add_leaf(s, 0, across, door);
    }
    wall(0, zs[row], xs.back(), wide, {}, outer);
  }
  for (int column = 0; column <= columns; ++column) {
    for (std::size_t i = 0; i + 1 < zs.size(); ++i) {
      const float from = zs[i] + thick, to = zs[i + 1];
      const float across = xs[column];
      if (column == 0 || column == columns) {
        wall(2, across, from, to, window(from, to), outer);
        continue;
      }
      const Opening door = somewhere(draw, from, to, doorway_width, 0, doorway_height);
      wall(2, across, from, to, {door}, s.matte());
      if (draw.chance(0.6f)) add_leaf(s, 2, across, door);
    }
  }

  int room = 0;
  for (std::size_t j = 0; j + 1 < zs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < xs.size(); ++i, ++room) {
      const vec3 least(xs[i] + thick, 0, zs[j] + thick), most(xs[i + 1], height, zs[j + 1]);
      const vec3 middle = (least + most) / 2.0f, half = (most - least) / 2.0f;
      // A quarter of the room each, away from the middle and from the doorways' ways through it.
      const float size = std::min(half.x, half.z) - 0.65f;
      for (int corner = 0; corner < 4 && size > 0.25f; ++corner) {
        if (!draw.chance(0.6f)) continue;
        const vec3 aside((corner % 2 == 0 ? -1.0f : 1.0f) * (half.x - size / 2 - 0.03f), 0,
                         (corner / 2 == 0 ? -1.0f : 1.0f) * (half.z - size / 2 - 0.03f));
        add_thing(s, vec3(middle.x, 0, middle.z) + aside, size, std::min(2.0f, height - 0.3f));
      }
      if (!day || draw.chance(0.3f) || (s.lamps == 0 && room + 1 == rows * columns)) {
        add_lamp(s, middle + vec3(-0.4f, 0.25f * height, -0.4f),
                 middle + vec3(0.4f, 0.5f * height - 0.16f, 0.4f), 4 * half.x * half.z);
      }
      if (room < 4) {
        const vec3 eye(middle.x + 0.15f, 1.5f, middle.z + 0.15f);
        const float target_z = draw.chance(0.5f) ? least.z : most.z;
        const vec3 target(draw.chance(0.5f) ? least.x : most.x, 0.9f, target_z);
        s.b.camera(fmt::format("room-{}", room + 1), eye, target, 65);
      }
    }
  }
  if (day) s.b.camera("outside", {wide + 8, 5, deep + 9}, {wide / 2, 1, deep / 2}, 45);
}

}  // namespace ssphh::scene
