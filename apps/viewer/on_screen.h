#pragma once
/// Where things of the scene appear in the window, for what is drawn over the picture and for the mouse.

#include <optional>

#include <imgui.h>

#include <ssphh/core/math.h>

namespace ssphh::viewer {

class App;

/// Pixels from the window's upper left corner; none for a point behind the eye or next to it.
std::optional<ImVec2> on_screen(const App& app, const vec3& point);

/// Metres that the handles' axes are long at a place, such that they have one size on the screen.
float axis_length(const App& app, const vec3& point);

/// Colours of the axes x, y and z, and of what belongs to the selection.
inline constexpr ImU32 axis_colors[3] = {IM_COL32(235, 80, 80, 255), IM_COL32(110, 210, 90, 255),
                                         IM_COL32(90, 150, 250, 255)};
inline constexpr ImU32 chosen_color = IM_COL32(255, 190, 80, 255);

}  // namespace ssphh::viewer
