#pragma once
/// What the mouse drags, and where in the window.

#include <optional>

#include "gestures.h"
#include "ring.h"

namespace ssphh::viewer {

/// The part of the window in which the scene is shown, pixels from the upper left.
struct Rect2 {
  float x = 0, y = 0, width = 1, height = 1;
  bool contains(float px, float py) const { return px >= x && py >= y && px < x + width && py < y + height; }
  float aspect() const { return width / height; }
};

/// What the mouse drags.
struct Drag {
  enum class What { none, view, look, pan, object, axis, ring, aim, wipe } what = What::none;
  Grip grip;                  ///< of objects
  RingGrip ring;              ///< of rings
  float turned = 0;           ///< of a ring, since the press [rad]
  bool moved = false;         ///< since the press
  float way = 0;              ///< of the mouse since then [pixels]
  std::optional<vec3> pivot;  ///< what a turn of the view turns about; none: the view's focus

  /// Whether view or scene follow the mouse: not before it moves, and the wipe's line is neither.
  bool changes_picture() const { return moved && what != What::none && what != What::wipe; }
};
}  // namespace ssphh::viewer
