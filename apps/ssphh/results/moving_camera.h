#pragma once
/// Where cameras and lamps are that the commands move by themselves.

#include <ssphh/scene/query.h>

namespace ssphh::app {

/// The camera turned where it stands about the vertical by a share of a full turn, counter-clockwise seen
/// from above.
scene::CameraPose turned(scene::CameraPose pose, float share);

/// Looks at the middle of the box from a distance at which a ball a twentieth larger than the one around it
/// just fits. `turn` and `elevation` in radians: 0 looks along −z, a quarter turn along −x.
scene::CameraPose orbit(const scene::Bounds& box, float yfov, float aspect, float elevation, float turn);

/// From 0 to 1 and back, smoothly, once in 100 frames.
float forth_and_back(int frame);

}  // namespace ssphh::app
