/// What a host has set is as it was after whatever this library has set: every query of it, and of every
/// index.

#include <map>

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <ssphh/gl/buffer.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/saved_state.h>
#include <ssphh/gl/texture.h>
#include <ssphh/gl/vertex_array.h>

#include "gl_context.h"

namespace ssphh::gl {
namespace {

constexpr GLenum all_switches[] = {GL_FRAMEBUFFER_SRGB,
                                   GL_RASTERIZER_DISCARD,
                                   GL_COLOR_LOGIC_OP,
                                   GL_POLYGON_OFFSET_FILL,
                                   GL_DEPTH_CLAMP,
                                   GL_SAMPLE_MASK,
                                   GL_SAMPLE_ALPHA_TO_COVERAGE,
                                   GL_PRIMITIVE_RESTART,
                                   GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                   GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                   GL_DEPTH_TEST,
                                   GL_CULL_FACE,
                                   GL_STENCIL_TEST};
constexpr GLuint units = 16, bindings = 8, attachments = 8, views = 16;

/// All that SavedState promises, by name and index.
using State = std::map<std::string, std::vector<double>>;

State state_now() {
  State state;
  const auto add = [&](const std::string& name, GLenum query, int count = 1) {
    GLint values[4] = {};
    glGetIntegerv(query, values);
    state[name].assign(values, values + count);
  };
  const auto add_indexed = [&](const std::string& name, GLenum query, GLuint count, int numbers = 1) {
    for (GLuint i = 0; i < count; ++i) {
      GLint values[4] = {};
      glGetIntegeri_v(query, i, values);
      state[name + " " + std::to_string(i)].assign(values, values + numbers);
    }
  };
  add("program", GL_CURRENT_PROGRAM), add("vertex array", GL_VERTEX_ARRAY_BINDING);
  add("draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING), add("read framebuffer", GL_READ_FRAMEBUFFER_BINDING);
  add("dispatch", GL_DISPATCH_INDIRECT_BUFFER_BINDING);
  add("depth function", GL_DEPTH_FUNC), add("depth mask", GL_DEPTH_WRITEMASK), add("cull", GL_CULL_FACE_MODE);
  add("front face", GL_FRONT_FACE), add("active texture", GL_ACTIVE_TEXTURE),
      add("polygons", GL_POLYGON_MODE);
  add("clip origin", GL_CLIP_ORIGIN), add("clip depth", GL_CLIP_DEPTH_MODE);
  add("pack", GL_PACK_ALIGNMENT), add("unpack", GL_UNPACK_ALIGNMENT);
  for (const GLenum query :
       {GL_STENCIL_FUNC, GL_STENCIL_FAIL, GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_PASS_DEPTH_PASS,
        GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_WRITEMASK, GL_STENCIL_BACK_FUNC,
        GL_STENCIL_BACK_FAIL, GL_STENCIL_BACK_PASS_DEPTH_FAIL, GL_STENCIL_BACK_PASS_DEPTH_PASS,
        GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK, GL_STENCIL_BACK_WRITEMASK})
    add("stencil " + std::to_string(query), query);
  for (const GLenum query : {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYER,
                             GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT})
    add_indexed("image " + std::to_string(query), query, 1);
  for (const GLenum what : all_switches)
    state["switch " + std::to_string(what)] = {double(glIsEnabled(what))};
  for (const GLenum query : {GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA, GL_BLEND_SRC_RGB,
                             GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA})
    add_indexed("blending " + std::to_string(query), query, attachments);
  add_indexed("colour mask", GL_COLOR_WRITEMASK, attachments, 4);
  for (GLuint i = 0; i < attachments; ++i)
    state["blends " + std::to_string(i)] = {double(glIsEnabledi(GL_BLEND, i))};
  add_indexed("viewport", GL_VIEWPORT, views, 4), add_indexed("scissor", GL_SCISSOR_BOX, views, 4);
  for (GLuint i = 0; i < views; ++i)
    state["scissors " + std::to_string(i)] = {double(glIsEnabledi(GL_SCISSOR_TEST, i))};
  for (const GLenum query :
       {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_3D, GL_SAMPLER_BINDING})
    add_indexed("unit " + std::to_string(query), query, units);
  for (const GLenum query : {GL_UNIFORM_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_BINDING}) {
    add("buffer " + std::to_string(query), query);
    add_indexed("buffers " + std::to_string(query), query, bindings);
  }
  for (const GLenum query : {GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, GL_SHADER_STORAGE_BUFFER_START,
                             GL_SHADER_STORAGE_BUFFER_SIZE})
    add_indexed("range " + std::to_string(query), query, bindings);
  return state;
}

/// Objects of a host.
struct Objects {
  std::vector<Texture> flat, arrays;
  std::vector<GLuint> volumes;
  std::vector<Sampler> samplers;
  Buffer buffer{8192}, other{8192};
  GLuint program = 0;

  Objects() {
    for (GLuint i = 0; i < units; ++i) {
      flat.emplace_back(Format::rgba8, 2, 2), arrays.emplace_back(Format::rgba8, 2, 2, 1);
      samplers.emplace_back(Address::repeat, Address::repeat, true);
      GLuint id = 0;
      glCreateTextures(GL_TEXTURE_3D, 1, &id);
      glTextureStorage3D(id, 1, GL_RGBA8, 1, 1, 1);
      volumes.push_back(id);
    }
    const char* text = "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n";
    program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
  }
  ~Objects() {
    glUseProgram(0);
    glDeleteProgram(program);
    glDeleteTextures(static_cast<GLsizei>(volumes.size()), volumes.data());
  }
  Objects(const Objects&) = delete;
};

/// Sets everything, of each index another value; `turn` decides which.
void set_all(const Objects& o, const VertexArray& array, const Framebuffer& draw, const Framebuffer& read,
             unsigned turn) {
  const bool first = turn == 0;
  glUseProgram(first ? o.program : 0);
  if (first)
    array.bind();
  else
    glBindVertexArray(0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, first ? draw.id() : read.id());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, first ? read.id() : draw.id());
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, first ? o.buffer.id() : o.other.id());
  glDepthFunc(first ? GL_LESS : GL_GEQUAL), glDepthMask(first ? GL_FALSE : GL_TRUE);
  glCullFace(first ? GL_FRONT : GL_BACK), glFrontFace(first ? GL_CW : GL_CCW);
  glPolygonMode(GL_FRONT_AND_BACK, first ? GL_POINT : GL_LINE);
  glClipControl(first ? GL_UPPER_LEFT : GL_LOWER_LEFT, first ? GL_NEGATIVE_ONE_TO_ONE : GL_ZERO_TO_ONE);
  glPixelStorei(GL_PACK_ALIGNMENT, first ? 2 : 8), glPixelStorei(GL_UNPACK_ALIGNMENT, first ? 8 : 1);
  glStencilFuncSeparate(GL_FRONT, first ? GL_LESS : GL_EQUAL, first ? 3 : 4, first ? 0x5 : 0x6);
  glStencilFuncSeparate(GL_BACK, first ? GL_GREATER : GL_NEVER, first ? 7 : 8, first ? 0x9 : 0xa);
  glStencilOpSeparate(GL_FRONT, first ? GL_ZERO : GL_KEEP, first ? GL_INCR : GL_DECR,
                      first ? GL_INVERT : GL_REPLACE);
  glStencilOpSeparate(GL_BACK, first ? GL_REPLACE : GL_ZERO, first ? GL_INVERT : GL_KEEP,
                      first ? GL_DECR : GL_INCR);
  glStencilMaskSeparate(GL_FRONT, first ? 0x11 : 0x12), glStencilMaskSeparate(GL_BACK, first ? 0x13 : 0x14);
  if (first) {
    glBindImageTexture(0, o.arrays[3].id(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32UI);
  } else {
    glBindImageTexture(0, o.arrays[4].id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA8);
  }
  for (std::size_t i = 0; i < std::size(all_switches); ++i)
    (i % 2 == turn ? glEnable : glDisable)(all_switches[i]);
  constexpr GLenum factors[] = {GL_ZERO,      GL_ONE,       GL_SRC_COLOR,      GL_DST_COLOR,
                                GL_SRC_ALPHA, GL_DST_ALPHA, GL_CONSTANT_COLOR, GL_CONSTANT_ALPHA};
  for (GLuint i = 0; i < attachments; ++i) {
    (i % 2 == turn ? glEnablei : glDisablei)(GL_BLEND, i);
    glColorMaski(i, i & 1 ? GL_TRUE : GL_FALSE, i & 2 ? GL_TRUE : GL_FALSE, i & 4 ? GL_TRUE : GL_FALSE,
                 i % 2 == turn);
    glBlendEquationSeparatei(i, first ? GL_FUNC_SUBTRACT : GL_MIN, first ? GL_FUNC_REVERSE_SUBTRACT : GL_MAX);
    const auto factor = [&](GLuint k) { return factors[(i + k + 4 * turn) % 8]; };
    glBlendFuncSeparatei(i, factor(0), factor(1), factor(2), factor(3));
  }
  for (GLuint i = 0; i < views; ++i) {
    const auto f = static_cast<float>(i + 40 * turn);
    glViewportIndexedf(i, f + 1, f + 2, f + 3, f + 4);
    const auto n = static_cast<GLint>(i + 60 * turn);
    glScissorIndexed(i, n + 5, n + 6, n + 7, n + 8);
    (i % 2 == turn ? glEnablei : glDisablei)(GL_SCISSOR_TEST, i);
  }
  for (GLuint i = 0; i < units; ++i) {
    const GLuint k = first ? i : units - 1 - i;
    glActiveTexture(GL_TEXTURE0 + i);
    glBindTexture(GL_TEXTURE_2D, o.flat[k].id());
    glBindTexture(GL_TEXTURE_2D_ARRAY, o.arrays[k].id());
    glBindTexture(GL_TEXTURE_3D, o.volumes[k]);
    o.samplers[k].bind(i);
  }
  glActiveTexture(first ? GL_TEXTURE7 : GL_TEXTURE2);
  for (GLuint i = 0; i < bindings; ++i) {
    const GLuint buffer = first ? o.buffer.id() : o.other.id();
    for (const GLenum target : {GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER}) {
      const GLintptr at = 256 * (1 + 10 * turn + (target == GL_UNIFORM_BUFFER ? i : bindings - i));
      i % 3 == turn ? glBindBufferBase(target, i, buffer)
                    : glBindBufferRange(target, i, buffer, at, 16 * (i + 1 + turn));
    }
  }
  glBindBuffer(GL_UNIFORM_BUFFER, first ? o.other.id() : 0),
      glBindBuffer(GL_SHADER_STORAGE_BUFFER, first ? 0 : o.other.id());
}

class GlSavedState : public test::WithGl {
 protected:
  /// Others find what OpenGL begins with where they rely on it.
  void TearDown() override {
    if (!IsSkipped()) gl().forget_errors();
  }
};

TEST_F(GlSavedState, PutsBackAllThatItPromises) {
  const SavedState begins;
  const Objects objects;
  const VertexArray array;
  const Texture color(Format::rgba8, 4, 4);
  const Texture stencil(Format::depth32f_stencil8, 4,
                        4);  // without, references of its functions are told as 0
  const Texture* colors[] = {&color};
  const Framebuffer draw(colors, &stencil), read(colors, &stencil);
  for (const unsigned turn : {0u, 1u}) {
    set_all(objects, array, draw, read, turn);
    const State before = state_now();
    {
      const SavedState saved;
      set_all(objects, array, draw, read, 1 - turn);
      const State within = state_now();
      for (const auto& [name, values] : before) {
        // Of each of these some indices and values are the same by chance; all others are not.
        if (!name.starts_with("colour mask") && !name.starts_with("image")) {
          EXPECT_NE(within.at(name), values) << name << ": this test does not change it";
        }
      }
    }
    const State after = state_now();
    for (const auto& [name, values] : before) EXPECT_EQ(after.at(name), values) << name;
  }
  EXPECT_NO_THROW(gl().throw_on_error("state"));
}

TEST_F(GlSavedState, PutsNothingInThePlaceOfWhatIsGone) {
  const SavedState begins;
  std::optional<Texture> texture(std::in_place, Format::rgba8, 2, 2);
  std::optional<Buffer> buffer(std::in_place, 256);
  std::optional<Sampler> sampler(std::in_place, Address::repeat, Address::repeat, true);
  std::optional<VertexArray> array(std::in_place);
  std::optional<Framebuffer> framebuffer(std::in_place, *texture, 0);
  texture->bind(5), texture->bind_image(0), sampler->bind(5), array->bind();
  bind_framebuffer(framebuffer->id(), {0, 0, 2, 2});
  buffer->bind_uniform(3), buffer->bind_storage(4);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer->id());
  {
    const SavedState saved;
    framebuffer.reset(), texture.reset(), buffer.reset(), sampler.reset(), array.reset();
  }
  const State now = state_now();
  for (const auto& [name, values] : now) {
    for (const char* object :
         {"vertex array", "draw framebuffer", "read framebuffer", "dispatch", "unit", "buffer"})
      if (name.starts_with(object)) {
        EXPECT_EQ(values, std::vector<double>{0}) << name;
      }
  }
  EXPECT_NO_THROW(gl().throw_on_error("state"));
}

}  // namespace
}  // namespace ssphh::gl
