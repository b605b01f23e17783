#include "drawn.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "expected_text.h"

namespace ssphh::viewer {
namespace {

unsigned in_order(ImU32 c) {
  return (c & 255) << 24 | (c >> 8 & 255) << 16 | (c >> 16 & 255) << 8 | c >> 24;
}

/// Reads the triangles of one command; a thing ends where corners follow that it has not touched: later ones,
/// or earlier ones, as a table's columns are drawn one after the other and their rows' corners made in turns.
class Reader {
 public:
  Reader() {
    for (const ImFontGlyph& glyph : ImGui::GetFont()->Glyphs) {
      if (glyph.Visible) glyphs_[{glyph.U0, glyph.V0}] = &glyph;
    }
  }
  std::vector<DrawnThing> things;

  void read(const ImDrawList& list, const ImDrawCmd& command) {
    const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset;
    int first = -1, last = -1;
    const auto end = [&] {
      if (first >= 0) add(list.VtxBuffer.Data + command.VtxOffset, first, last, command.ClipRect);
    };
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
      const auto [low, high] = std::minmax({int{index[i]}, int{index[i + 1]}, int{index[i + 2]}});
      if (first < 0 || low > last || high < first) end(), first = low, last = high;
      last = std::max(last, high);
    }
    end();
    text_ = false;
  }

 private:
  void add(const ImDrawVert* corners, int first, int last, const ImVec4& clip) {
    if (last - first == 3) {
      const auto glyph = glyphs_.find({corners[first].uv.x, corners[first].uv.y});
      if (glyph != glyphs_.end()) return add_letter(*glyph->second, corners + first, clip);
    }
    text_ = false;
    DrawnThing thing{"", corners[first].pos, corners[first].pos, corners[first].col, last - first + 1};
    for (int i = first; i <= last; ++i) {
      const ImVec2 p = corners[i].pos;
      thing.from = {std::min(thing.from.x, p.x), std::min(thing.from.y, p.y)};
      thing.to = {std::max(thing.to.x, p.x), std::max(thing.to.y, p.y)};
      if (corners[i].col >> 24 > thing.color >> 24) thing.color = corners[i].col;
    }
    thing.color = in_order(thing.color);
    things.push_back(thing);
  }

  void add_letter(const ImFontGlyph& glyph, const ImDrawVert* corners, const ImVec4& clip) {
    const ImDrawVert& corner = corners[0];
    const ImVec2 pen{corner.pos.x - glyph.X0, corner.pos.y - glyph.Y0};
    const float gap = pen.x - next_.x;
    const bool goes_on = text_ && next_.y == pen.y && gap > -0.5f && gap < 1.5f * glyph.AdvanceX &&
                         things.back().color == in_order(corner.col);
    if (!goes_on) things.push_back({"", pen, pen, in_order(corner.col), 0});
    if (goes_on) things.back().text.append(static_cast<std::size_t>(gap / glyph.AdvanceX + 0.5f), ' ');
    const auto c = static_cast<unsigned>(glyph.Codepoint);
    if (c < 0x80)
      things.back().text += static_cast<char>(c);
    else
      things.back().text += fmt::format("<{:x}>", c);
    next_ = {pen.x + glyph.AdvanceX, pen.y};
    const ImVec2 from = corner.pos, to = corners[2].pos;
    things.back().end = next_.x;
    if (to.y > clip.y && from.y < clip.w)
      things.back().cut |=
          to.x - from.x < glyph.X1 - glyph.X0 - 0.01f || to.x > clip.z + 0.5f || pen.x < clip.x - 0.5f;
    text_ = true;
  }

  /// By where in the font's texture their pictures begin: other corners are those of shapes.
  std::map<std::pair<float, float>, const ImFontGlyph*> glyphs_;
  bool text_ = false;
  ImVec2 next_;
};

/// Rounded, halves down: ImGui's lines end near quarters of a pixel by a reciprocal root whose last bits
/// differ between makers of processors.
float tenths(float pixels) {
  return std::ceil(10 * pixels - 0.55f) / 10 + 0.0f;  // + 0: no negative zero
}

std::string line_of(const DrawnThing& t) {
  if (!t.text.empty())
    return fmt::format("text {:.1f},{:.1f} #{:08x} {}", tenths(t.from.x), tenths(t.from.y), t.color, t.text);
  return fmt::format("shape {:.1f},{:.1f} to {:.1f},{:.1f} #{:08x} {}", tenths(t.from.x), tenths(t.from.y),
                     tenths(t.to.x), tenths(t.to.y), t.color, t.corners);
}

}  // namespace

std::vector<DrawnThing> drawn_things(const ImDrawList& list) {
  Reader reader;
  for (const ImDrawCmd& command : list.CmdBuffer) reader.read(list, command);
  return reader.things;
}

std::string drawn_listing() {
  std::string out;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImVec4 r = command.ClipRect;
      out += fmt::format("{} within {:.1f},{:.1f} to {:.1f},{:.1f}\n",
                         list._OwnerName ? list._OwnerName : "?", r.x, r.y, r.z, r.w);
      Reader reader;
      reader.read(list, command);
      for (const DrawnThing& thing : reader.things) out += "  " + line_of(thing) + "\n";
    }
  }
  return out;
}

void expect_drawn(const std::string& name, const std::string& listing) {
  test::expect_text_of("apps/viewer/tests/drawn/" + name + ".txt", listing);
}

}  // namespace ssphh::viewer
