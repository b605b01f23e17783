#pragma once
/// What is short and what is long in a scene: a watch and a hall are looked at alike.

#include <string>

#include <ssphh/scene/query.h>

namespace ssphh::viewer {

struct Lengths {
  float least;   ///< about the shortest that somebody looks at [m]; a tenth of a metre in rooms and halls
  float step;    ///< by which a number changes when it is dragged by a pixel [m]; a centimetre in a room
  int decimals;  ///< that a step has, two at least
};
Lengths lengths_of(const scene::Bounds& bounds);

/// Step of places that are dragged in steps [m]; a tenth of a metre in a room.
float snap_step(const Lengths& lengths);

/// Of printf.
const char* length_format(int decimals);

/// A length with four digits of `scale`, never "-0".
std::string length_text(float length, float scale);

}  // namespace ssphh::viewer
