#include "covered_colors.h"

#include <cmath>

#include <ssphh/core/math.h>

namespace ssphh::realtime {
namespace {

/// Colours times coverage, and coverage.
struct Level {
  int width, height;
  std::vector<vec4> texels;

  Level(int w, int h)
      : width(w), height(h), texels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), vec4(0)) {}
  vec4& at(int x, int y) {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

}  // namespace

std::vector<std::uint8_t> covered_colors(const scene::Texture& texture) {
  std::vector<std::uint8_t> out = texture.rgba;
  if (out.empty()) return out;
  std::vector<Level> levels = {{texture.width, texture.height}};
  for (std::size_t i = 0; i < levels[0].texels.size(); ++i) {
    const vec3 color(out[4 * i], out[4 * i + 1], out[4 * i + 2]);
    const float alpha = static_cast<float>(out[4 * i + 3]) / 255;
    levels[0].texels[i] = vec4(alpha * color, alpha);
  }
  // Pull: sums of four.
  while (levels.back().width > 1 || levels.back().height > 1) {
    Level next((levels.back().width + 1) / 2, (levels.back().height + 1) / 2);
    for (int y = 0; y < levels.back().height; ++y)
      for (int x = 0; x < levels.back().width; ++x) next.at(x / 2, y / 2) += levels.back().at(x, y);
    levels.push_back(std::move(next));
  }
  if (!(levels.back().texels[0].w > 0)) return out;
  // Push: what lacks of full coverage comes from above.
  for (std::size_t l = levels.size(); l-- > 0;) {
    for (int y = 0; y < levels[l].height; ++y) {
      for (int x = 0; x < levels[l].width; ++x) {
        vec4& texel = levels[l].at(x, y);
        if (texel.w >= 1) {
          texel /= texel.w;
        } else if (l + 1 < levels.size()) {
          texel += (1 - texel.w) * levels[l + 1].at(x / 2, y / 2);
        } else {
          texel /= texel.w;
        }
      }
    }
  }
  for (std::size_t i = 0; i < levels[0].texels.size(); ++i) {
    if (out[4 * i + 3] > 0) continue;
    for (int c = 0; c < 3; ++c)
      out[4 * i + static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(std::lround(glm::clamp(levels[0].texels[i][c], 0.0f, 255.0f)));
  }
  return out;
}

}  // namespace ssphh::realtime
