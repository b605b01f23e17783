#pragma once
/// Cameras that nobody put into the scene: an eye and what it looks at, as text.

#include <optional>
#include <string>

#include <ssphh/scene/query.h>

namespace ssphh::scene {

struct PlacedCamera {
  CameraPose pose;
  float distance;  ///< from the eye to what it looks at [m]
};

/// The camera that a text of the form "X,Y,Z:TO_X,TO_Y,TO_Z" or "X,Y,Z:TO_X,TO_Y,TO_Z:DEGREES" describes: at
/// a place in the world [m], toward another, upright, with that vertical field of view, else one of 50°;
/// its name is the text. None for a text that begins with no place, a camera's name. Throws Error for what
/// else cannot be read, where both places are one, and for a field of view outside of (0, 180).
std::optional<PlacedCamera> placed_camera(const std::string& text);

}  // namespace ssphh::scene
