#pragma once
/// How the user interface looks.

namespace ssphh::viewer {

/// Font, colours and spacing of the current ImGui context. `scale`: pixels of the display per point of an
/// ordinary one.
void apply_style(float scale);

}  // namespace ssphh::viewer
