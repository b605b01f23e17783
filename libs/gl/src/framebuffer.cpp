#include <vector>

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
    attachments[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
    glNamedFramebufferTexture(id, attachments[i], colors[i]->id(), 0);
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

void clear_color_uint(int attachment, unsigned r, unsigned g, unsigned b, unsigned a) {
  const unsigned color[] = {r, g, b, a};
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearBufferuiv(GL_COLOR, attachment, color);
}

void texture_barrier() {
  glTextureBarrier();
}

unsigned current_framebuffer() {
  GLint id = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &id);
  return static_cast<unsigned>(id);
}

}  // namespace ssphh::gl
