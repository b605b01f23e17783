#pragma once
/// Walls with openings, and what stands in rooms, in metres.

#include <vector>

#include "builder.h"

namespace ssphh::scene {

/// Along a wall, from `from` to `to` metres, open between two heights, or closed by a pane in the wall's
/// middle.
struct Opening {
  float from, to, low, high;
  int pane = -1;  ///< its material; −1: there is none
};

/// Boxes along x (axis 0) or z (axis 2).
struct Wall {
  int axis = 0;
  float across = 0;          ///< the lesser coordinate of its faces on the other axis
  float begin = 0, end = 1;  ///< along the axis
  float height = 2.7f, thick = 0.2f;
  std::vector<Opening> openings;  ///< in ascending order
};
void add_wall(Builder& b, const std::string& name, const Wall& wall, int material);

/// Tables, sofas and shelves stand with the least corner of their bounds at `corner`.
void add_table(Builder& b, const vec3& corner, const vec2& size, float top, int material);
void add_sofa(Builder& b, const vec3& corner, int material);
void add_shelf(Builder& b, const vec3& corner, const vec3& size, int boards, int material);
/// Up along +x, `steps` of 0.17 by 0.28 m, `width` along z.
void add_stairs(Builder& b, const vec3& corner, int steps, float width, int material);
/// A pot with lid, spout and handle, 0.3 m across the belly: smooth everywhere.
void add_teapot(Builder& b, const vec3& foot, float size, int material);

struct HousePaint {
  int outer, inner, red, roof, cloth, wood, white, pane;
};
HousePaint house_paint(Builder& b);
/// Three furnished rooms with panes in their windows, and a corridor: x 0…12.2, z 0…8.2, without floor.
void add_house(Builder& b, const HousePaint& paint);

}  // namespace ssphh::scene
