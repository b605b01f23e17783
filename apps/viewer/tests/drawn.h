#pragma once
/// What ImGui drew, read back from its triangles: each text with its place and colour, each other shape with
/// its box, colour and number of corners.

#include <string>
#include <vector>

#include <imgui.h>

namespace ssphh::viewer {

struct DrawnThing {
  std::string text;  ///< empty: a shape
  ImVec2 from, to;   ///< box; of a text the upper left corner of its line, twice
  unsigned color;    ///< 0xRRGGBBAA, of the most opaque corner
  int corners = 0;
  float end = 0;     ///< of a text: where its last letter ends
  bool cut = false;  ///< of a text: a letter is not whole, at its right or left
};

/// Of one list, e.g. ImGui::GetBackgroundDrawList().
std::vector<DrawnThing> drawn_things(const ImDrawList& list);

/// Of the whole frame after ImGui::Render(), a line each.
std::string drawn_listing();

/// The listing is that of the file apps/viewer/tests/drawn/NAME.txt. A change there is
/// a change of what users see (tests/support/expected_text.h says how the file is written anew).
void expect_drawn(const std::string& name, const std::string& listing);

}  // namespace ssphh::viewer
