#include "results/label.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace ssphh::app {
namespace {

/// The viewer's default font, as grey pixels.
struct Letters {
  ImFontAtlas atlas;
  const ImFont* font = atlas.AddFontDefault();
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;

  Letters() { atlas.GetTexDataAsAlpha8(&pixels, &width, &height); }
};

const Letters& letters() {
  static const Letters letters;
  return letters;
}

/// The first character of UTF-8 text, which it takes away; '?' beyond Latin-1.
ImWchar next_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  std::size_t length = 1;
  while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) ++length;
  ImWchar character = first;
  if (first >= 0x80) {
    const bool latin = length == 2 && (first == 0xc2 || first == 0xc3);
    character =
        latin ? static_cast<ImWchar>((first & 3) << 6 | (static_cast<unsigned char>(text[1]) & 0x3f)) : '?';
  }
  text.remove_prefix(length);
  return character;
}

}  // namespace

int label_height() {
  return static_cast<int>(letters().font->FontSize);
}

void write_label(image::Image& picture, int x, int y, int width, std::string_view text, const vec3& color) {
  const Letters& from = letters();
  const int end = std::min(x + width, picture.width);
  float at = static_cast<float>(x);
  while (!text.empty()) {
    const ImFontGlyph* glyph = from.font->FindGlyph(next_character(text));
    if (at + glyph->AdvanceX > static_cast<float>(end)) return;
    const auto pixel = [](float share, int size) {
      return static_cast<int>(std::lround(share * static_cast<float>(size)));
    };
    const int u0 = pixel(glyph->U0, from.width), v0 = pixel(glyph->V0, from.height);
    const int columns = pixel(glyph->U1, from.width) - u0, rows = pixel(glyph->V1, from.height) - v0;
    const int left = static_cast<int>(std::lround(at + glyph->X0)),
              top = y + static_cast<int>(std::lround(glyph->Y0));
    for (int j = std::max(0, -top); j < std::min(rows, picture.height - top); ++j) {
      for (int i = std::max(0, -left); i < std::min(columns, picture.width - left); ++i) {
        const float ink = static_cast<float>(from.pixels[(v0 + j) * from.width + u0 + i]) / 255;
        picture.set_rgb(left + i, top + j, glm::mix(picture.rgb(left + i, top + j), color, ink));
      }
    }
    at += glyph->AdvanceX;
  }
}

}  // namespace ssphh::app
