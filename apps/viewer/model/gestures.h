#pragma once
/// What keys and the mouse do to the view and to what is shown: pure functions. Keys are named by the capital
/// letter, digit or sign on them.

#include <array>
#include <functional>
#include <optional>

#include "settings.h"
#include "view_camera.h"

namespace ssphh::viewer {

/// Where the keys that are held fly to, by ±1 along each of the view's right, up and forward: D and A, E and
/// Q, W and S. Keys of both ways cancel.
vec3 fly_direction(const std::function<bool(char key)>& held);

/// What a drag does to the view: turns it about its focus, on the spot, or moves it sideways.
enum class ViewDrag { orbit, look, pan };

/// Dragged by `pixels` to the right and downward in a picture `height` pixels high. Orbit and look turn right
/// and down by 0.005 rad a pixel; pan keeps what stands at the focus under the mouse.
View dragged(const View& view, ViewDrag drag, const vec2& pixels, float height);

/// The wheel turned forward by so many notches: each leaves 0.9 of the distance to the focus.
View wheeled(const View& view, float notches);

/// The keys that change settings. Their own storage: a literal may be another one in each file.
inline constexpr std::array setting_keys = {' ', 'P', 'L', 'G', 'T', 'J', 'K', 'U', 'M', '1',
                                            '2', '3', '4', '5', '6', '7', '8', '[', ']', '\\'};

/// The settings once one of `setting_keys` was pressed: P balls, L lobes (with balls), G graph, T the next
/// comparison with the truth, J the histogram, U the waveform, K false colours, M one view, two or four, 1 to
/// 8 debug views, [ and ] half a stop darker and brighter, \ the exposure that suits the picture or stays;
/// the space bar plays what is `animated`.
Settings after_key(Settings settings, char key, bool animated);

/// How a thing is held that is dragged.
struct Grip {
  int axis = -1;    ///< 0..2: along the world's x, y, z; −1: in the plane through it that faces the view
  vec3 start{0};    ///< the thing's place when it was taken
  vec3 grabbed{0};  ///< point of that plane under the mouse then, or in x the place along the axis
};

/// Takes a thing at `place` by the ray under the mouse of a view that looks `forward`.
Grip taken(const rays::RayQuery& ray, const vec3& place, int axis, const vec3& forward);

/// Where the thing goes with the mouse; none where the ray runs along the axis or does not meet the plane.
std::optional<vec3> pulled(const Grip& grip, const rays::RayQuery& ray, const vec3& forward);

}  // namespace ssphh::viewer
