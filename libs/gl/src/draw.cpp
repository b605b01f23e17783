#include <algorithm>

#include <epoxy/gl.h>

#include <ssphh/gl/draw.h>

#include "switches.h"

namespace ssphh::gl {
namespace {

void enable(GLenum what, bool on) {
  on ? glEnable(what) : glDisable(what);
}

}  // namespace

void apply(const DrawState& state) {
  enable(GL_DEPTH_TEST, state.depth != Depth::off);
  glDepthMask(state.depth == Depth::test_and_write);
  glDepthFunc(GL_GEQUAL);
  enable(GL_BLEND, state.blend != Blend::off);
  glBlendEquation(GL_FUNC_ADD);
  if (state.blend == Blend::add) {
    glBlendFunc(GL_ONE, GL_ONE);
  } else if (state.blend == Blend::add_to_rest) {
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
  } else if (state.blend == Blend::multiply) {
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  } else {
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }
  enable(GL_CULL_FACE, state.cull != Cull::off);
  glCullFace(state.cull == Cull::front ? GL_FRONT : GL_BACK);
  const GLboolean color = state.color_write ? GL_TRUE : GL_FALSE;
  glColorMask(color, color, color, color);
  glPolygonMode(GL_FRONT_AND_BACK, state.lines ? GL_LINE : GL_FILL);
  glDisable(GL_SCISSOR_TEST);
  const bool writes = state.stencil_write >= 0, compares = state.stencil_equal >= 0;
  const int mark = state.stencil_mark, value = std::max({state.stencil_write, state.stencil_equal, 0});
  enable(GL_STENCIL_TEST, writes || compares || mark != 0);
  glStencilMask(static_cast<GLuint>(writes ? 0xff : mark));
  glStencilFunc(compares ? GL_EQUAL : GL_ALWAYS, value | mark, static_cast<GLuint>(0xff & ~mark));
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
}

void apply_conventions() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glFrontFace(GL_CCW);
  for (const GLenum unwanted : unwanted_switches) glDisable(unwanted);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
}

void draw_triangles(int vertex_count) {
  glDrawArrays(GL_TRIANGLES, 0, vertex_count);
}

std::size_t size_of(Index type) {
  return type == Index::u8 ? 1 : type == Index::u16 ? 2 : 4;
}

void draw_indexed(int count, std::size_t first_index, int base_vertex, Index type) {
  const void* offset = reinterpret_cast<const void*>(first_index * size_of(type));  // as GL wants it
  const GLenum words = type == Index::u8    ? GL_UNSIGNED_BYTE
                       : type == Index::u16 ? GL_UNSIGNED_SHORT
                                            : GL_UNSIGNED_INT;
  glDrawElementsBaseVertex(GL_TRIANGLES, count, words, offset, base_vertex);
}

void dispatch(const Buffer& groups) {
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, groups.id());
  glDispatchComputeIndirect(0);
}

void shader_memory_barrier() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void finish() {
  glFinish();
}

}  // namespace ssphh::gl
