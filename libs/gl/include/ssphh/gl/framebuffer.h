#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/gl/texture.h>

namespace ssphh::gl {

/// Textures to draw into. The default one, or any that another library made, is addressed by its number.
class Framebuffer {
 public:
  Framebuffer() = default;
  /// `depth` may be null, and so may colours: what shaders write there is dropped. Throws Error when the
  /// driver refuses the combination.
  Framebuffer(std::span<const Texture* const> colors, const Texture* depth);
  /// One layer of an array, depth or colour, nothing else; of a mipmap level.
  Framebuffer(const Texture& texture, int layer, int level = 0);

  unsigned id() const { return handle_.get(); }

 private:
  void check() const;
  Handle<delete_framebuffer> handle_;
};

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Everything drawn next goes into this framebuffer, inside `viewport` (origin at the lower left).
void bind_framebuffer(unsigned id, const Rect& viewport);
/// Within the viewport's rectangle only.
void clear_depth(const Rect& rect, float value);
void clear_stencil(int value);
void clear_color(int attachment, float r, float g, float b, float a);
void clear_color(const Rect& rect, int attachment, float r, float g, float b, float a);
void clear_color_uint(int attachment, unsigned r, unsigned g, unsigned b, unsigned a);
/// Colours of `part` of one into `over` of another, which may be smaller: of each of its texels one,
/// unfiltered.
void copy_colors(const Framebuffer& from, const Rect& part, const Framebuffer& to, const Rect& over);
/// One layer of a texture array, or of a texture the only one, from which texels are copied, or to which.
struct LayerPlace {
  const Texture& texture;
  int layer = 0, x = 0, y = 0;  ///< lower left corner
};
/// Texels of level 0 as they are, depths too, from one texture to another of the same format.
void copy_texels(const LayerPlace& from, const LayerPlace& to, int width, int height);
/// What was drawn into a texture may be read by what is drawn into other texels of it next.
void texture_barrier();
/// Colours of a part of a framebuffer (0: the window's own, before it is shown) as RGBA bytes with alpha 255,
/// the uppermost row first. Waits for what is being drawn.
std::vector<std::uint8_t> read_pixels(unsigned framebuffer, const Rect& part);

}  // namespace ssphh::gl
