#pragma once
/// The view of somebody who walks through the scene: pure functions.

#include <optional>

#include <ssphh/rays/posed_world.h>

#include "view_camera.h"

namespace ssphh::viewer {

/// An upright body below an eye [m].
struct Walker {
  float eye = 1.65f;  ///< above the ground
  float radius() const { return 0.15f * eye; }
  float step() const { return 0.28f * eye; }   ///< what is no higher is stepped on
  float speed() const { return 0.85f * eye; }  ///< a second
};

/// Grown-up where the scene is as high as a room, smaller in smaller ones.
Walker walker_for(const scene::Bounds& bounds);

/// The view from the first place between its eye and what it looks at below which there is ground; none:
/// there is no such place.
std::optional<View> above_ground(const View& view, const rays::PosedWorld& world);

/// The same view from the eye's height above the ground below it, or as high as there is room; perspective.
/// None where nothing is below.
std::optional<View> stood(const View& view, const Walker& walker, const rays::PosedWorld& world);

/// After a way on the level [m], x to the view's right and y forward, in `seconds`: stops `radius` before
/// walls and slides along them, steps on what is low, falls off what is high, and stays where it was if there
/// would be no ground below.
View walked(const View& view, const vec2& way, const Walker& walker, const rays::PosedWorld& world,
            float seconds);

}  // namespace ssphh::viewer
