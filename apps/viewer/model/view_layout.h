#pragma once
/// Where views stand side by side, and where a new one looks from.

#include <string>

#include <ssphh/rays/posed_world.h>

#include "drag.h"
#include "settings.h"
#include "view_camera.h"

namespace ssphh::viewer {

/// The place of one of `count` views (1 to most_views) within an area, with a gap between them: two beside
/// each other, or above each other where the area is higher than wide; of three the first over the whole
/// height (width), four in a square.
Rect2 cell(const Rect2& area, int place, int count);

/// Where a view of that place looks along at first: from above, from the front, from the right.
vec3 first_direction(int place);

/// The `whole` scene, or of a wide one what is around the view, along a direction (any length but 0),
/// orthographic, from as far away as `view` has free way to the other side: within a room without its ceiling
/// or its near wall.
View section(const View& view, const vec3& direction, const scene::Bounds& whole, float aspect,
             const rays::PosedWorld& world);

/// "top", "front", "right" and the opposite sides for orthographic views along an axis; "orthographic",
/// "perspective".
std::string view_name(const View& view);

}  // namespace ssphh::viewer
