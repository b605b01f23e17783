#pragma once
/// How the user interface looks.

namespace ssphh::viewer {

/// Of the current ImGui context. `scale`: pixels of the display per point of an ordinary one.
void load_font(float scale);
/// Colours and spacing.
void apply_look(float scale);

}  // namespace ssphh::viewer
