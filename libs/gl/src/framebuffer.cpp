#include <algorithm>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/gl/framebuffer.h>

namespace ssphh::gl {

void delete_framebuffer(unsigned id) {
  glDeleteFramebuffers(1, &id);
}

Framebuffer::Framebuffer(std::span<const Texture* const> colors, const Texture* depth) {
  unsigned id = 0;
  glCreateFramebuffers(1, &id);
  handle_ = Handle<delete_framebuffer>(id);
  GLenum attachments[8];
  require(colors.size() <= 8, "framebuffer", "it takes at most 8 colour textures");
  for (std::size_t i = 0; i < colors.size(); ++i) {
    attachments[i] = colors[i] ? GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i) : GL_NONE;
    if (colors[i]) glNamedFramebufferTexture(id, attachments[i], colors[i]->id(), 0);
  }
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(colors.size()), attachments);
  if (depth) {
    const bool stencil = depth->format() == Format::depth32f_stencil8;
    glNamedFramebufferTexture(id, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth->id(),
                              0);
  }
  check();
}

Framebuffer::Framebuffer(const Texture& texture, int layer, int level) {
  unsigned id = 0;
  glCreateFramebuffers(1, &id);
  handle_ = Handle<delete_framebuffer>(id);
  const bool depth = texture.format() == Format::depth32f;
  const GLenum attachment = depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0;
  glNamedFramebufferDrawBuffer(id, depth ? GL_NONE : attachment);
  glNamedFramebufferReadBuffer(id, depth ? GL_NONE : attachment);
  if (texture.layers() > 0) {
    glNamedFramebufferTextureLayer(id, attachment, texture.id(), level, layer);
  } else {
    glNamedFramebufferTexture(id, attachment, texture.id(), level);
  }
  check();
}

void Framebuffer::check() const {
  const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error("OpenGL", fmt::format("the driver refuses a framebuffer (status {:#06x})", status));
}

void bind_framebuffer(unsigned id, const Rect& viewport) {
  glBindFramebuffer(GL_FRAMEBUFFER, id);
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
}

void clear_depth(const Rect& rect, float value) {
  glDepthMask(GL_TRUE);
  glEnable(GL_SCISSOR_TEST);
  glScissor(rect.x, rect.y, rect.width, rect.height);
  glClearBufferfv(GL_DEPTH, 0, &value);
  glDisable(GL_SCISSOR_TEST);
}

void clear_stencil(int value) {
  glStencilMask(0xff);
  glClearBufferiv(GL_STENCIL, 0, &value);
}

void clear_color(int attachment, float r, float g, float b, float a) {
  const float color[] = {r, g, b, a};
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearBufferfv(GL_COLOR, attachment, color);
}

void clear_color(const Rect& rect, int attachment, float r, float g, float b, float a) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(rect.x, rect.y, rect.width, rect.height);
  clear_color(attachment, r, g, b, a);
  glDisable(GL_SCISSOR_TEST);
}

void clear_color_uint(int attachment, unsigned r, unsigned g, unsigned b, unsigned a) {
  const unsigned color[] = {r, g, b, a};
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearBufferuiv(GL_COLOR, attachment, color);
}

void copy_colors(const Framebuffer& from, const Rect& part, const Framebuffer& to, const Rect& over) {
  glDisable(GL_SCISSOR_TEST);
  glBlitNamedFramebuffer(from.id(), to.id(), part.x, part.y, part.x + part.width, part.y + part.height,
                         over.x, over.y, over.x + over.width, over.y + over.height, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
}

void copy_texels(const LayerPlace& from, const LayerPlace& to, int width, int height) {
  const auto target = [](const Texture& texture) {
    return texture.layers() > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  };
  glCopyImageSubData(from.texture.id(), target(from.texture), 0, from.x, from.y, from.layer, to.texture.id(),
                     target(to.texture), 0, to.x, to.y, to.layer, width, height, 1);
}

void texture_barrier() {
  glTextureBarrier();
}

std::vector<std::uint8_t> read_pixels(unsigned framebuffer, const Rect& part) {
  const auto row = 4 * static_cast<std::size_t>(part.width);
  const auto rows = static_cast<std::size_t>(part.height);
  std::vector<std::uint8_t> pixels(row * rows);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(part.x, part.y, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  // OpenGL's first row is the lowest one.
  for (std::size_t y = 0; y < rows / 2; ++y) {
    const auto lower = pixels.begin() + static_cast<std::ptrdiff_t>(y * row);
    std::swap_ranges(lower, lower + static_cast<std::ptrdiff_t>(row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - y) * row));
  }
  for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = 255;
  return pixels;
}

}  // namespace ssphh::gl
