/// An engine's OpenGL state around draw_indirect(): what it was, and no matter to the picture.

#include <map>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <ssphh/gl/buffer.h>

#include "engines_meshes.h"
#include "gl_context.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

using realtime::Renderer;

/// All that OpenGL tells of what this library's passes may touch, by the names of the specification's tables
/// of state; written down apart from what saves it.
std::map<std::string, std::vector<GLint64>> state_of_opengl() {
  std::map<std::string, std::vector<GLint64>> state;
  const auto add = [&](const std::string& name, GLenum what, std::size_t count = 1) {
    std::vector<GLint64>& values = state[name];
    values.resize(count);
    glGetInteger64v(what, values.data());
  };
  const auto add_each = [&](const std::string& name, GLenum what, GLuint end, std::size_t count = 1) {
    for (GLuint i = 0; i < end; ++i) {
      std::vector<GLint64>& values = state[name + " " + std::to_string(i)];
      values.resize(count);
      glGetInteger64i_v(what, i, values.data());
    }
  };
#define ADD(what) add(#what, GL_##what)
  ADD(CURRENT_PROGRAM), ADD(VERTEX_ARRAY_BINDING), ADD(ARRAY_BUFFER_BINDING), ADD(DRAW_FRAMEBUFFER_BINDING);
  ADD(READ_FRAMEBUFFER_BINDING), ADD(RENDERBUFFER_BINDING), ADD(DISPATCH_INDIRECT_BUFFER_BINDING);
  ADD(UNIFORM_BUFFER_BINDING), ADD(SHADER_STORAGE_BUFFER_BINDING), ADD(COPY_READ_BUFFER_BINDING);
  ADD(PIXEL_PACK_BUFFER_BINDING), ADD(PIXEL_UNPACK_BUFFER_BINDING), ADD(ACTIVE_TEXTURE);
  ADD(DEPTH_FUNC), ADD(DEPTH_WRITEMASK), ADD(CULL_FACE_MODE), ADD(FRONT_FACE), ADD(CLIP_ORIGIN);
  ADD(CLIP_DEPTH_MODE), ADD(LOGIC_OP_MODE), ADD(PROVOKING_VERTEX), ADD(PACK_ALIGNMENT), ADD(UNPACK_ALIGNMENT);
  ADD(PACK_ROW_LENGTH), ADD(UNPACK_ROW_LENGTH), ADD(STENCIL_FUNC), ADD(STENCIL_REF), ADD(STENCIL_VALUE_MASK);
  ADD(STENCIL_WRITEMASK), ADD(STENCIL_FAIL), ADD(STENCIL_PASS_DEPTH_FAIL), ADD(STENCIL_PASS_DEPTH_PASS);
  ADD(STENCIL_BACK_FUNC), ADD(STENCIL_BACK_REF), ADD(STENCIL_BACK_VALUE_MASK), ADD(STENCIL_BACK_WRITEMASK);
  ADD(STENCIL_BACK_FAIL), ADD(STENCIL_BACK_PASS_DEPTH_FAIL), ADD(STENCIL_BACK_PASS_DEPTH_PASS);
  ADD(STENCIL_CLEAR_VALUE), ADD(POLYGON_OFFSET_FACTOR), ADD(POLYGON_OFFSET_UNITS), ADD(LINE_WIDTH);
#undef ADD
  add("POLYGON_MODE", GL_POLYGON_MODE, 2);
  add("COLOR_CLEAR_VALUE", GL_COLOR_CLEAR_VALUE, 4);
  add("BLEND_COLOR", GL_BLEND_COLOR, 4);
  for (const GLenum what :
       {GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD,
        GL_COLOR_LOGIC_OP, GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_DEPTH_CLAMP, GL_SAMPLE_MASK,
        GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE, GL_TEXTURE_CUBE_MAP_SEAMLESS, GL_MULTISAMPLE,
        GL_DITHER, GL_PRIMITIVE_RESTART, GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_PROGRAM_POINT_SIZE})
    state[fmt::format("enabled {:#x}", what)] = {glIsEnabled(what)};
  for (GLuint i = 0; i < 8; ++i) state["blend " + std::to_string(i)] = {glIsEnabledi(GL_BLEND, i)};
  for (GLuint i = 0; i < 16; ++i) state["scissor " + std::to_string(i)] = {glIsEnabledi(GL_SCISSOR_TEST, i)};
  for (const auto& [name, what] : std::map<std::string, GLenum>{{"src rgb", GL_BLEND_SRC_RGB},
                                                                {"dst rgb", GL_BLEND_DST_RGB},
                                                                {"src alpha", GL_BLEND_SRC_ALPHA},
                                                                {"dst alpha", GL_BLEND_DST_ALPHA},
                                                                {"equation", GL_BLEND_EQUATION_RGB},
                                                                {"equation alpha", GL_BLEND_EQUATION_ALPHA}})
    add_each(name, what, 8);
  add_each("color mask", GL_COLOR_WRITEMASK, 8, 4);
  add_each("viewport", GL_VIEWPORT, 16, 4);
  add_each("scissor box", GL_SCISSOR_BOX, 16, 4);
  for (const auto& [name, what] :
       std::map<std::string, GLenum>{{"uniform buffer", GL_UNIFORM_BUFFER_BINDING},
                                     {"uniform start", GL_UNIFORM_BUFFER_START},
                                     {"uniform size", GL_UNIFORM_BUFFER_SIZE},
                                     {"storage", GL_SHADER_STORAGE_BUFFER_BINDING},
                                     {"storage start", GL_SHADER_STORAGE_BUFFER_START},
                                     {"storage size", GL_SHADER_STORAGE_BUFFER_SIZE}})
    add_each(name, what, 8);
  for (const auto& [name, what] : std::map<std::string, GLenum>{{"image", GL_IMAGE_BINDING_NAME},
                                                                {"image level", GL_IMAGE_BINDING_LEVEL},
                                                                {"image layer", GL_IMAGE_BINDING_LAYER},
                                                                {"image access", GL_IMAGE_BINDING_ACCESS},
                                                                {"image format", GL_IMAGE_BINDING_FORMAT}})
    add_each(name, what, 4);
  for (const auto& [name, what] : std::map<std::string, GLenum>{{"2D", GL_TEXTURE_BINDING_2D},
                                                                {"2D array", GL_TEXTURE_BINDING_2D_ARRAY},
                                                                {"3D", GL_TEXTURE_BINDING_3D},
                                                                {"cube", GL_TEXTURE_BINDING_CUBE_MAP},
                                                                {"buffer", GL_TEXTURE_BINDING_BUFFER},
                                                                {"sampler", GL_SAMPLER_BINDING}})
    add_each(name, what, 24);
  return state;
}

/// A state unlike the one that any pass sets, as far as it can be.
class OddState {
 public:
  OddState() : texture_(gl::Format::rgba32f, 4, 4), array_(gl::Format::rgba32f, 4, 4, 2), buffer_(4096) {
    glGenTextures(1, &cube_);
    glBindTexture(GL_TEXTURE_CUBE_MAP, cube_);
    for (GLuint i = 0; i < 16; ++i) {
      glActiveTexture(GL_TEXTURE0 + i);
      glBindTexture(GL_TEXTURE_2D, texture_.id());
      if (i % 2) glBindTexture(GL_TEXTURE_2D_ARRAY, array_.id());
      if (i % 3) glBindTexture(GL_TEXTURE_CUBE_MAP, cube_);
      sampler_.bind(i);
      glViewportIndexedf(i, 1, 2, 3.0f + static_cast<float>(i), 5);
      glScissorIndexed(i, 0, 0, 1, static_cast<GLsizei>(i));
      if (i % 2) glEnablei(GL_SCISSOR_TEST, i);
    }
    glActiveTexture(GL_TEXTURE5);
    for (GLuint i = 0; i < 8; ++i) {
      if (i % 2) glEnablei(GL_BLEND, i);
      glColorMaski(i, i % 2 == 0, GL_FALSE, i % 3 == 0, GL_TRUE);
      glBlendFuncSeparatei(i, GL_DST_COLOR, GL_ZERO, GL_SRC_ALPHA, GL_ONE);
      glBlendEquationSeparatei(i, GL_MIN, GL_FUNC_SUBTRACT);
      glBindBufferRange(GL_UNIFORM_BUFFER, i, buffer_.id(), 256 * i, 512);
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffer_.id());
    }
    glBindBuffer(GL_UNIFORM_BUFFER, 0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer_.id());
    glBindImageTexture(0, array_.id(), 0, GL_FALSE, 1, GL_READ_ONLY, GL_RGBA32F);
    for (const GLenum what : switched_) glEnable(what);
    glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glLogicOp(GL_INVERT);
    glPrimitiveRestartIndex(2);
    glPolygonOffset(3, 5);
    glSampleMaski(0, 0);
    glDepthFunc(GL_NEVER), glDepthMask(GL_FALSE), glCullFace(GL_FRONT_AND_BACK), glFrontFace(GL_CW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT), glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glStencilFuncSeparate(GL_FRONT, GL_NEVER, 3, 5), glStencilFuncSeparate(GL_BACK, GL_LESS, 7, 9);
    glStencilOpSeparate(GL_FRONT, GL_INCR, GL_DECR, GL_INVERT);
    glStencilOpSeparate(GL_BACK, GL_ZERO, GL_INVERT, GL_INCR);
    glStencilMaskSeparate(GL_FRONT, 11), glStencilMaskSeparate(GL_BACK, 13);
    glPixelStorei(GL_PACK_ALIGNMENT, 2), glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  }
  ~OddState() { glDeleteTextures(1, &cube_); }

 private:
  static constexpr GLenum switched_[] = {GL_CULL_FACE,           GL_DEPTH_TEST,
                                         GL_STENCIL_TEST,        GL_FRAMEBUFFER_SRGB,
                                         GL_COLOR_LOGIC_OP,      GL_RASTERIZER_DISCARD,
                                         GL_POLYGON_OFFSET_FILL, GL_DEPTH_CLAMP,
                                         GL_SAMPLE_MASK,         GL_SAMPLE_ALPHA_TO_COVERAGE,
                                         GL_PRIMITIVE_RESTART};
  GLuint cube_ = 0;
  gl::Texture texture_, array_;
  gl::Sampler sampler_{gl::Address::mirror, gl::Address::clamp, false};
  gl::Buffer buffer_;
};

TEST(HostState, IsAsItWasAndChangesNothingInThePicture) {
  std::optional<gl::Context> context;
  try {
    context.emplace(gl::Context::headless());
  } catch (const Error& e) {
    GTEST_SKIP() << e.what();
  }
  const scene::Scene scene = stage(matte({0.9f, 0.3f, 0.5f}));
  realtime::FrameSettings settings;
  settings.indirect_scale = 2, settings.ambient_occlusion = true;
  Renderer renderer(*context, scene);
  renderer.set_probes(made_up_probes({{0, 1, 1}, {1, 1, 1}}));
  renderer.draw(scene::camera_pose(scene, ""), {}, {.width = 32, .height = 20});
  const std::vector<vec4> up(32 * 20, vec4(0, 1, 0, 0));
  const std::vector<float> depths(32 * 20, 0.97f);
  gl::Texture normal(gl::Format::rgba32f, 32, 20), depth(gl::Format::r32f, 32, 20);
  normal.upload(std::as_bytes(std::span(up)));
  depth.upload(std::as_bytes(std::span(depths)));
  const mat4 view = glm::inverse(scene::camera_pose(scene, "").world);
  const realtime::GBuffer gbuffer{.depth = depth.id(),
                                  .normal = normal.id(),
                                  .view_projection = glm::perspectiveRH_NO(1.0f, 1.6f, 0.1f, 40.0f) * view};
  const auto pixels = [](const gl::Texture& texture) {
    std::vector<float> texels(4 * 32 * 20);
    texture.read(texels, 4);
    return texels;
  };
  const std::vector<float> plain = pixels(renderer.draw_indirect(gbuffer, settings));
  EXPECT_GT(std::ranges::count_if(plain, [](float v) { return v > 0; }), 500);
  const OddState odd;
  const auto before = state_of_opengl();
  const gl::Texture& found = renderer.draw_indirect(gbuffer, settings);
  const auto after = state_of_opengl();
  for (const auto& [name, values] : before) EXPECT_EQ(values, after.at(name)) << name;
  EXPECT_EQ(pixels(found), plain);

  // The scene itself, as probes' maps show it, from an engine's buffers
  const EnginesMeshes engine(scene);
  Renderer fresh(*context, scene, {}, 0, engine.meshes);
  fresh.set_probes(made_up_probes({{0, 1, 1}, {1, 1, 1}}));
  const auto made = state_of_opengl();
  for (const auto& [name, values] : after) {
    if (name.ends_with("PACK_ALIGNMENT")) continue;
    EXPECT_EQ(values, made.at(name)) << name << ", of the constructor";
  }
  const gl::Texture& light = fresh.draw_indirect(gbuffer, settings);
  EXPECT_EQ(state_of_opengl(), made);
  EXPECT_EQ(pixels(light), plain);

  realtime::GBuffer wrong = gbuffer;
  wrong.view_projection = mat4(0);
  const auto unharmed = state_of_opengl();
  EXPECT_THROW(renderer.draw_indirect(wrong), Error);
  EXPECT_EQ(state_of_opengl(), unharmed);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace ssphh::test
