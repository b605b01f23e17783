#include <algorithm>
#include <array>

#include <epoxy/gl.h>

#include <ssphh/gl/saved_state.h>

#include "switches.h"

namespace ssphh::gl {
namespace {

constexpr GLuint texture_units = 16, buffer_bindings = 8, attachments = 8, most_viewports = 16;
constexpr std::array texture_targets{std::pair{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                                     std::pair{GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                                     std::pair{GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D}};
constexpr std::array buffer_targets{
    std::array<GLenum, 4>{GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                          GL_UNIFORM_BUFFER_SIZE},
    std::array<GLenum, 4>{GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING,
                          GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE}};

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}
GLint integer(GLenum name, GLuint index) {
  GLint value = 0;
  glGetIntegeri_v(name, index, &value);
  return value;
}
GLuint object(GLenum name) {
  return static_cast<GLuint>(integer(name));
}
GLuint object(GLenum name, GLuint index) {
  return static_cast<GLuint>(integer(name, index));
}
GLenum word(GLenum name) {
  return static_cast<GLenum>(integer(name));
}
GLenum word(GLenum name, GLuint index) {
  return static_cast<GLenum>(integer(name, index));
}
GLuint viewports() {
  return std::min(object(GL_MAX_VIEWPORTS), most_viewports);
}
/// What was bound may have been an object of this library, deleted since.
GLuint living(GLboolean is_one, GLuint id) {
  return is_one == GL_TRUE ? id : 0;
}
void enable(GLenum what, GLuint index, bool on) {
  on ? glEnablei(what, index) : glDisablei(what, index);
}

struct Attachment {
  bool blend = false;
  std::array<GLboolean, 4> mask{};
  std::array<GLenum, 2> equation{};
  std::array<GLenum, 4> function{};

  void read(GLuint i) {
    blend = glIsEnabledi(GL_BLEND, i);
    glGetBooleani_v(GL_COLOR_WRITEMASK, i, mask.data());
    equation = {word(GL_BLEND_EQUATION_RGB, i), word(GL_BLEND_EQUATION_ALPHA, i)};
    function = {word(GL_BLEND_SRC_RGB, i), word(GL_BLEND_DST_RGB, i), word(GL_BLEND_SRC_ALPHA, i),
                word(GL_BLEND_DST_ALPHA, i)};
  }
  void write(GLuint i) const {
    enable(GL_BLEND, i, blend);
    glColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
    glBlendEquationSeparatei(i, equation[0], equation[1]);
    glBlendFuncSeparatei(i, function[0], function[1], function[2], function[3]);
  }
};

struct StencilFace {
  GLenum face, function, fail, depth_fail, pass;
  GLint reference;
  GLuint compared, written;

  void write() const {
    glStencilFuncSeparate(face, function, reference, compared);
    glStencilOpSeparate(face, fail, depth_fail, pass);
    glStencilMaskSeparate(face, written);
  }
};

StencilFace front_stencil() {
  return {GL_FRONT,
          word(GL_STENCIL_FUNC),
          word(GL_STENCIL_FAIL),
          word(GL_STENCIL_PASS_DEPTH_FAIL),
          word(GL_STENCIL_PASS_DEPTH_PASS),
          integer(GL_STENCIL_REF),
          object(GL_STENCIL_VALUE_MASK),
          object(GL_STENCIL_WRITEMASK)};
}
StencilFace back_stencil() {
  return {GL_BACK,
          word(GL_STENCIL_BACK_FUNC),
          word(GL_STENCIL_BACK_FAIL),
          word(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
          word(GL_STENCIL_BACK_PASS_DEPTH_PASS),
          integer(GL_STENCIL_BACK_REF),
          object(GL_STENCIL_BACK_VALUE_MASK),
          object(GL_STENCIL_BACK_WRITEMASK)};
}

struct Viewport {
  std::array<GLfloat, 4> rect{};
  std::array<GLint, 4> scissor{};
  bool scissors = false;
};

struct BufferRange {
  GLuint buffer = 0;
  GLint64 start = 0, size = 0;
};

struct TextureUnit {
  std::array<GLuint, texture_targets.size()> textures{};
  GLuint sampler = 0;
};

struct ImageUnit {
  GLuint texture = object(GL_IMAGE_BINDING_NAME, 0);
  GLint level = integer(GL_IMAGE_BINDING_LEVEL, 0), layer = integer(GL_IMAGE_BINDING_LAYER, 0);
  bool layered = integer(GL_IMAGE_BINDING_LAYERED, 0) != 0;
  GLenum access = word(GL_IMAGE_BINDING_ACCESS, 0), format = word(GL_IMAGE_BINDING_FORMAT, 0);
};

}  // namespace

struct SavedState::Data {
  GLuint program = object(GL_CURRENT_PROGRAM), vertex_array = object(GL_VERTEX_ARRAY_BINDING),
         draw_framebuffer = object(GL_DRAW_FRAMEBUFFER_BINDING),
         read_framebuffer = object(GL_READ_FRAMEBUFFER_BINDING),
         dispatch = object(GL_DISPATCH_INDIRECT_BUFFER_BINDING);
  GLenum depth_function = word(GL_DEPTH_FUNC), cull_face = word(GL_CULL_FACE_MODE),
         front_face = word(GL_FRONT_FACE), active_texture = word(GL_ACTIVE_TEXTURE),
         polygon_mode = word(GL_POLYGON_MODE), clip_origin = word(GL_CLIP_ORIGIN),
         clip_depth = word(GL_CLIP_DEPTH_MODE);
  bool depth_mask = integer(GL_DEPTH_WRITEMASK) != 0;
  GLint pack = integer(GL_PACK_ALIGNMENT), unpack = integer(GL_UNPACK_ALIGNMENT);
  StencilFace front = front_stencil(), back = back_stencil();
  ImageUnit image;
  std::array<bool, changed_switches.size()> switches{};
  std::array<Attachment, attachments> colors;
  std::array<Viewport, most_viewports> views;
  std::array<TextureUnit, texture_units> units;
  std::array<std::array<BufferRange, buffer_bindings>, buffer_targets.size()> ranges;
  std::array<GLuint, buffer_targets.size()> buffers{};

  Data() {
    for (std::size_t i = 0; i < switches.size(); ++i) switches[i] = glIsEnabled(changed_switches[i]);
    for (GLuint i = 0; i < attachments; ++i) colors[i].read(i);
    for (GLuint i = 0; i < viewports(); ++i) {
      glGetFloati_v(GL_VIEWPORT, i, views[i].rect.data());
      glGetIntegeri_v(GL_SCISSOR_BOX, i, views[i].scissor.data());
      views[i].scissors = glIsEnabledi(GL_SCISSOR_TEST, i);
    }
    for (GLuint i = 0; i < texture_units; ++i) {
      for (std::size_t t = 0; t < texture_targets.size(); ++t)
        units[i].textures[t] = object(texture_targets[t].second, i);
      units[i].sampler = object(GL_SAMPLER_BINDING, i);
    }
    for (std::size_t t = 0; t < buffer_targets.size(); ++t) {
      const auto& [target, bound, start, size] = buffer_targets[t];
      buffers[t] = object(bound);
      for (GLuint i = 0; i < buffer_bindings; ++i) {
        BufferRange& range = ranges[t][i];
        range.buffer = object(bound, i);
        glGetInteger64i_v(start, i, &range.start);
        glGetInteger64i_v(size, i, &range.size);
      }
    }
  }

  void restore() const {
    glUseProgram(living(glIsProgram(program), program));
    glBindVertexArray(living(glIsVertexArray(vertex_array), vertex_array));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, living(glIsFramebuffer(draw_framebuffer), draw_framebuffer));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, living(glIsFramebuffer(read_framebuffer), read_framebuffer));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, living(glIsBuffer(dispatch), dispatch));
    glDepthFunc(depth_function);
    glDepthMask(depth_mask ? GL_TRUE : GL_FALSE);
    glCullFace(cull_face);
    glFrontFace(front_face);
    glPolygonMode(GL_FRONT_AND_BACK, polygon_mode);
    glClipControl(clip_origin, clip_depth);
    glPixelStorei(GL_PACK_ALIGNMENT, pack);
    glPixelStorei(GL_UNPACK_ALIGNMENT, unpack);
    front.write();
    back.write();
    glBindImageTexture(0, living(glIsTexture(image.texture), image.texture), image.level, image.layered,
                       image.layer, image.access, image.format);
    for (std::size_t i = 0; i < switches.size(); ++i)
      switches[i] ? glEnable(changed_switches[i]) : glDisable(changed_switches[i]);
    for (GLuint i = 0; i < attachments; ++i) colors[i].write(i);
    for (GLuint i = 0; i < viewports(); ++i) {
      glViewportIndexedfv(i, views[i].rect.data());
      glScissorIndexedv(i, views[i].scissor.data());
      enable(GL_SCISSOR_TEST, i, views[i].scissors);
    }
    for (GLuint i = 0; i < texture_units; ++i) {
      glActiveTexture(GL_TEXTURE0 + i);
      for (std::size_t t = 0; t < texture_targets.size(); ++t)
        glBindTexture(texture_targets[t].first,
                      living(glIsTexture(units[i].textures[t]), units[i].textures[t]));
      glBindSampler(i, living(glIsSampler(units[i].sampler), units[i].sampler));
    }
    glActiveTexture(active_texture);
    for (std::size_t t = 0; t < buffer_targets.size(); ++t) {
      const GLenum target = buffer_targets[t][0];
      for (GLuint i = 0; i < buffer_bindings; ++i) {
        const auto& [bound, start, size] = ranges[t][i];
        const GLuint buffer = living(glIsBuffer(bound), bound);
        // A whole buffer has neither
        buffer != 0 && size > 0 ? glBindBufferRange(target, i, buffer, static_cast<GLintptr>(start),
                                                    static_cast<GLsizeiptr>(size))
                                : glBindBufferBase(target, i, buffer);
      }
      glBindBuffer(target, living(glIsBuffer(buffers[t]), buffers[t]));
    }
  }
};

SavedState::SavedState() : data_(std::make_unique<Data>()) {}
SavedState::~SavedState() {
  data_->restore();
}

}  // namespace ssphh::gl
