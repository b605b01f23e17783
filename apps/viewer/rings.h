#pragma once
/// The rings by which the selected lamp is turned, over the picture and under the mouse.

#include <optional>

#include "model/ring.h"

struct ImDrawList;

namespace ssphh::viewer {

class App;

struct RingUnderMouse {
  int index = 0;  ///< 0..2 about the world's x, y, z; 3 about the lamp's aim
  Ring ring;
  vec3 at{0};  ///< point of the ring that is nearest to the mouse
};
/// None where no lamp with a direction is selected, and on the half of a ring that faces away.
std::optional<RingUnderMouse> ring_under_mouse(const App& app, float x, float y);

/// Steps in which things are dragged, of places [m] and angles [rad]; 0 where they go freely.
float place_step(const App& app);
float angle_step(const App& app);

void draw_rings(const App& app, ImDrawList& list);
/// What a drag of a handle has done so far, beside the mouse: degrees of a ring, else the place.
void draw_drag_value(const App& app, ImDrawList& list);

}  // namespace ssphh::viewer
