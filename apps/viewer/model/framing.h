#pragma once
/// Views of a thing that go through no wall, nor through glass.

#include <ssphh/rays/posed_world.h>

#include "view_camera.h"

namespace ssphh::viewer {

/// As much of `bounds` in sight as there is room for: the eye stands where it can be reached from where it is
/// without passing a surface, by choice looking as it does now, else along the line on which it sees the
/// middle now. A thing that no such place sees, as one in the next room, is seen from within its own room.
/// Where there is no place either, the eye stays and turns toward it. Unchanged for empty bounds.
View framed_within(const View& view, const scene::Bounds& bounds, float aspect,
                   const rays::PosedWorld& world);

/// The same turn as orbited() has, about another point, which stays where it is in the picture and becomes
/// the focus' distance. Unchanged for a point that is not before the eye.
View orbited_about(const View& view, const vec3& point, float yaw, float pitch);
/// The same, but where the eye would pass a surface it comes nearer to the point, which stays where it is in
/// the picture, until it passes none. Unchanged where there is no such place. A parallel view passes all.
View orbited_within(const View& view, const vec3& point, float yaw, float pitch,
                    const rays::PosedWorld& world);

}  // namespace ssphh::viewer
