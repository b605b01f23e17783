#include <array>
#include <cmath>

#include <ssphh/image/transfer.h>
#include <ssphh/shading/surface.h>

#include "material_lookup.h"

namespace ssphh::shading {
namespace {

/// Linear values of the 256 codes, of sRGB or of a linear channel.
using CodeTable = std::array<float, 256>;

CodeTable make_table(bool srgb) {
  CodeTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto code = static_cast<std::uint8_t>(i);
    table[i] = srgb ? image::srgb8_to_linear(code) : static_cast<float>(i) / 255;
  }
  return table;
}

const CodeTable& code_table(bool srgb) {
  static const CodeTable linear = make_table(false), encoded = make_table(true);
  return srgb ? encoded : linear;
}

/// Brings a texture coordinate into [0, 1]; NaN and infinity to 0.
float wrap_coordinate(float x, scene::Wrap wrap) {
  if (wrap == scene::Wrap::repeat) {
    x -= std::floor(x);
  } else if (wrap == scene::Wrap::mirror) {
    x -= 2 * std::floor(0.5f * x);
    x = x > 1 ? 2 - x : x;
  } else {
    x = glm::clamp(x, 0.0f, 1.0f);
  }
  return x >= 0 && x <= 1 ? x : 0.0f;
}

/// Index of a texel that may lie one outside the image.
int wrap_texel(int i, int size, scene::Wrap wrap) {
  if (i < 0) return wrap == scene::Wrap::repeat ? size - 1 : 0;
  if (i >= size) return wrap == scene::Wrap::repeat ? 0 : size - 1;
  return i;
}

}  // namespace

vec2 transform_uv(const scene::TextureUse& use, const vec2& uv) {
  return transform_uv_direction(use, uv) + use.offset;
}

vec2 transform_uv_direction(const scene::TextureUse& use, const vec2& uv) {
  const vec2 scaled = use.scale * uv;
  if (use.rotation == 0) return scaled;
  // Counter-clockwise as seen on the image, whose v points down
  const float c = std::cos(use.rotation), s = std::sin(use.rotation);
  return {c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x};
}

vec4 sample_texture(const scene::Scene& scene, const scene::TextureUse& use, const vec2 (&uv)[2], bool srgb) {
  if (use.texture < 0) return vec4(1);
  const scene::Texture& texture = scene.textures[use.texture];
  const int width = texture.width, height = texture.height;
  if (width <= 0 || height <= 0) return vec4(1);
  const CodeTable& color = code_table(srgb);
  const CodeTable& linear = code_table(false);
  const auto texel = [&](int x, int y) {
    const std::size_t i =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    const std::uint8_t* p = &texture.rgba[i];
    return vec4(color[p[0]], color[p[1]], color[p[2]], linear[p[3]]);
  };

  // Find the place in texels
  const vec2 at = transform_uv(use, uv[use.uv_set == 1 ? 1 : 0]);
  const float x = wrap_coordinate(at.x, use.wrap_u) * static_cast<float>(width);
  const float y = wrap_coordinate(at.y, use.wrap_v) * static_cast<float>(height);
  if (use.nearest) {
    return texel(glm::min(static_cast<int>(x), width - 1), glm::min(static_cast<int>(y), height - 1));
  }

  // Interpolate between the four nearest texel centres
  const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
  const float fx = x - 0.5f - left, fy = y - 0.5f - top;
  const int x0 = wrap_texel(static_cast<int>(left), width, use.wrap_u);
  const int x1 = wrap_texel(static_cast<int>(left) + 1, width, use.wrap_u);
  const int y0 = wrap_texel(static_cast<int>(top), height, use.wrap_v);
  const int y1 = wrap_texel(static_cast<int>(top) + 1, height, use.wrap_v);
  return (1 - fy) * ((1 - fx) * texel(x0, y0) + fx * texel(x1, y0)) +
         fy * ((1 - fx) * texel(x0, y1) + fx * texel(x1, y1));
}

}  // namespace ssphh::shading
