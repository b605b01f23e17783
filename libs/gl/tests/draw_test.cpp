/// Fixed-function state by what it lets be drawn, and which vertices the draw calls take.

#include <numeric>

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "shaders.h"

namespace ssphh::gl {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr vec4 red(1, 0, 0, 1), black(0);

/// A picture of 2 × 1 with depth, which starts as `black` and 0.
class GlDraw : public WithShaders {
 protected:
  void SetUp() override {
    WithShaders::SetUp();
    if (IsSkipped()) return;
    apply_conventions();
    colors = Texture(Format::rgba32f, 2, 1);
    depths = Texture(Format::depth32f, 2, 1);
    target = Framebuffer(std::array<const Texture*, 1>{&colors}, &depths);
    program = whole_picture();
    vertices.emplace();
    begin(0);
  }
  void TearDown() override {
    if (IsSkipped()) return;
    apply({});
    apply_conventions();
    gl().throw_on_error("after the test");
  }
  void begin(float depth) {
    bind_framebuffer(target.id(), {0, 0, 2, 1});
    clear_color(0, 0, 0, 0, 0);
    clear_depth({0, 0, 2, 1}, depth);
    vertices->bind();
  }
  vec4 draw(const DrawState& state, float depth = 0, const vec4& color = red) {
    apply(state);
    program.set("depth", depth);
    program.set("color", color);
    program.use();
    draw_triangles(3);
    const std::vector<vec4> drawn = texels_of(colors);
    EXPECT_EQ(drawn[0], drawn[1]);
    return drawn[0];
  }

  Texture colors, depths;
  Framebuffer target;
  Program program;
  std::optional<VertexArray> vertices;  // made when there is a context
};

TEST_F(GlDraw, StateWithoutAWordDrawsEverythingAndKeepsDepthAndStencil) {
  const auto& [depth, blend, cull, color_write, lines, stencil_equal, stencil_write, stencil_mark] =
      DrawState{};
  EXPECT_EQ(depth, Depth::off);
  EXPECT_EQ(blend, Blend::off);
  EXPECT_EQ(cull, Cull::off);
  EXPECT_TRUE(color_write);
  EXPECT_FALSE(lines);
  EXPECT_EQ(stencil_equal, -1);
  EXPECT_EQ(stencil_write, -1);
  EXPECT_EQ(stencil_mark, 0);
}

TEST_F(GlDraw, WhatIsAsNearOrNearerPassesTheDepthTest) {
  for (const Depth test : {Depth::test, Depth::test_and_write}) {
    begin(0.5f);
    EXPECT_EQ(draw({.depth = test}, 0.25f), black);
    EXPECT_EQ(draw({.depth = test}, 0.5f), red);
    EXPECT_EQ(draw({.depth = test}, 0.75f, vec4(2)), vec4(2));
    EXPECT_THAT(floats_of(depths), Each(test == Depth::test ? 0.5f : 0.75f));
  }
}

TEST_F(GlDraw, WithoutADepthTestEverythingIsDrawnAndNoDepthWritten) {
  begin(0.5f);
  EXPECT_EQ(draw({}, 0.25f), red);
  EXPECT_THAT(floats_of(depths), Each(0.5f));
}

TEST_F(GlDraw, BlendingAddsOrPaintsOver) {
  const vec4 below(1, 2, 4, 0.5f), above(8, 16, 32, 0.25f);
  const auto blended = [&](Blend blend) {
    clear_color(0, below.x, below.y, below.z, below.w);
    return draw({.blend = blend}, 0, above);
  };
  EXPECT_EQ(blended(Blend::off), above);
  EXPECT_EQ(blended(Blend::add), below + above);
  EXPECT_EQ(blended(Blend::over), vec4(2.75f, 5.5f, 11, 0.625f)) << "a quarter of it, and its alpha";
}

TEST_F(GlDraw, CullingLeavesOutBacksOrFronts) {
  const auto drawn = [&](Cull cull, bool clockwise) {
    program = whole_picture(clockwise);
    begin(0);
    return draw({.cull = cull}) == red;
  };
  EXPECT_TRUE(drawn(Cull::off, false) && drawn(Cull::off, true));
  EXPECT_TRUE(drawn(Cull::back, false));
  EXPECT_FALSE(drawn(Cull::back, true));
  EXPECT_FALSE(drawn(Cull::front, false));
  EXPECT_TRUE(drawn(Cull::front, true));
}

TEST_F(GlDraw, ColourThatIsNotWrittenLeavesTheDepth) {
  EXPECT_EQ(draw({.depth = Depth::test_and_write, .color_write = false}, 0.5f), black);
  EXPECT_THAT(floats_of(depths), Each(0.5f));
}

TEST_F(GlDraw, LinesAreTheEdgesOfTrianglesOnly) {
  EXPECT_EQ(draw({.lines = true}), black) << "the edges lie outside of the picture";
  EXPECT_EQ(draw({}), red);
}

TEST_F(GlDraw, AnythingSomebodyElseLeftBehindIsUndone) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 0, 0);
  glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
  glBlendFunc(GL_ZERO, GL_ZERO);
  glDepthFunc(GL_NEVER);
  glStencilFunc(GL_NEVER, 7, 0xff);
  glStencilOp(GL_INVERT, GL_INVERT, GL_INVERT);
  glCullFace(GL_FRONT_AND_BACK);
  glFrontFace(GL_CW);
  glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
  glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  apply_conventions();
  EXPECT_EQ(draw({.depth = Depth::test_and_write, .blend = Blend::add, .cull = Cull::back}, 0.25f), red);
  EXPECT_THAT(floats_of(depths), Each(0.25f)) << "the clip space is 0..1 deep";
}

TEST_F(GlDraw, ConventionsHold) {
  glEnable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  apply_conventions();
  EXPECT_FALSE(glIsEnabled(GL_FRAMEBUFFER_SRGB));
  EXPECT_TRUE(glIsEnabled(GL_TEXTURE_CUBE_MAP_SEAMLESS));
  GLint origin = 0;
  glGetIntegerv(GL_CLIP_ORIGIN, &origin);
  EXPECT_EQ(origin, GL_LOWER_LEFT);
}

/// Depth with a stencil, of which the value is found by drawing where it is equal.
class GlStencil : public GlDraw {
 protected:
  void SetUp() override {
    GlDraw::SetUp();
    if (IsSkipped()) return;
    depths = Texture(Format::depth32f_stencil8, 2, 1);
    target = Framebuffer(std::array<const Texture*, 1>{&colors}, &depths);
    begin(0.5f);
    clear_stencil(0);
  }
  bool stencil_is(int value) {
    clear_color(0, 0, 0, 0, 0);
    return draw({.stencil_equal = value}) == red;
  }
};

TEST_F(GlStencil, IsClearedToAnyOfItsValuesWhateverTheMask) {
  glStencilMask(0);
  for (const int value : {0, 1, 0xaa, 0xff}) {
    clear_stencil(value);
    EXPECT_TRUE(stencil_is(value)) << value;
    EXPECT_FALSE(stencil_is(value ^ 1)) << value;
  }
}

TEST_F(GlStencil, IsWrittenWhereTheDepthTestPasses) {
  EXPECT_EQ(draw({.depth = Depth::test, .stencil_write = 5}, 0.25f), black);
  EXPECT_TRUE(stencil_is(0));
  EXPECT_EQ(draw({.depth = Depth::test, .stencil_write = 5}, 0.75f), red);
  EXPECT_TRUE(stencil_is(5));
  draw({.stencil_write = 0});
  EXPECT_TRUE(stencil_is(0)) << "0 is a value, too";
}

TEST_F(GlStencil, IsKeptByWhatDoesNotWriteIt) {
  clear_stencil(3);
  draw({});
  draw({.stencil_equal = 3});
  EXPECT_TRUE(stencil_is(3));
  EXPECT_EQ(draw({.stencil_equal = 0}, 0, vec4(2)), red) << "nowhere";
}

TEST_F(GlStencil, MarkStandsBesideTheValueAndIsNotCompared) {
  clear_stencil(3);
  draw({.stencil_mark = 0x80});
  EXPECT_TRUE(stencil_is(0x83));
  clear_color(0, 0, 0, 0, 0);
  EXPECT_EQ(draw({.stencil_equal = 3, .stencil_mark = 0x80}), red);
  EXPECT_TRUE(stencil_is(0x83));
}

class GlDrawCalls : public GlDraw {
 protected:
  static std::vector<float> red_of(const Texture& texture) {
    std::vector<float> reds;
    for (const vec4& texel : texels_of(texture)) reds.push_back(texel.x);
    return reds;
  }
  void paint(Program& with, const Framebuffer& into, int width, int height) {
    bind_framebuffer(into.id(), {0, 0, width, height});
    clear_color(0, 0, 0, 0, 0);
    apply({});
    with.set("color", red);
    with.set("depth", 0.0f);
    with.use();
    vertices->bind();
  }
};

// Triangle k covers column k of four: it is as high as 4 pictures, to be as wide as a column within one.
TEST_F(GlDrawCalls, TrianglesTakeAsManyVerticesAsTheyAreTold) {
  const Texture picture(Format::rgba32f, 4, 1);
  const Framebuffer into(std::array<const Texture*, 1>{&picture}, nullptr);
  Program columns = paint_program(
      "vec2(-1 + 0.5 * (gl_VertexID / 3) + (gl_VertexID % 3 == 1 ? 0.5 : 0.0),"
      " gl_VertexID % 3 == 2 ? 40 : -1)");
  paint(columns, into, 4, 1);
  draw_triangles(6);
  EXPECT_THAT(red_of(picture), ElementsAre(1, 1, 0, 0));
}

// Vertices of 16 bytes: an unused number, x, y, and the column to be drawn into.
TEST_F(GlDrawCalls, IndexedVerticesAreReadWhereTheirBufferHoldsThem) {
  std::vector<float> numbers;
  for (int column = 0; column < 4; ++column)
    for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(-1, 40)})
      numbers.insert(numbers.end(), {99, corner.x, corner.y, static_cast<float>(column)});
  const std::array<unsigned, 9> order{0, 1, 2, 3, 4, 5, 6, 7, 8};
  const Buffer corners{std::span<const float>(numbers)}, indices{std::span<const unsigned>(order)};
  vertices->attribute(0, {corners.id(), 4, 16}, 2);
  vertices->attribute(3, {corners.id(), 12, 16}, 1);
  vertices->indices(indices.id());
  Program columns = paint_program("vec2(-1 + 0.5 * column + 0.25 * (at.x + 1), at.y)",
                                  "layout(location = 0) in vec2 at;\nlayout(location = 3) in float column;");
  const Texture picture(Format::rgba32f, 4, 1);
  const Framebuffer into(std::array<const Texture*, 1>{&picture}, nullptr);
  const auto drawn = [&](int count, std::size_t first, int base, Index type = Index::u32) {
    paint(columns, into, 4, 1);
    draw_indexed(count, first, base, type);
    return red_of(picture);
  };
  EXPECT_THAT(drawn(3, 0, 0), ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(drawn(6, 0, 0), ElementsAre(1, 1, 0, 0));
  EXPECT_THAT(drawn(3, 6, 0), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(drawn(3, 3, 6), ElementsAre(0, 0, 0, 1));
  const std::array<std::uint16_t, 5> words{9, 9, 3, 4, 5};
  const std::array<std::uint8_t, 4> octets{9, 6, 7, 8};
  const Buffer by_words{std::span<const std::uint16_t>(words)},
      by_octets{std::span<const std::uint8_t>(octets)};
  vertices->indices(by_words.id());
  EXPECT_THAT(drawn(3, 2, 0, Index::u16), ElementsAre(0, 1, 0, 0));
  vertices->indices(by_octets.id());
  EXPECT_THAT(drawn(3, 1, 0, Index::u8), ElementsAre(0, 0, 1, 0));
}

// A software renderer orders commands without barriers, so that no picture there misses one.
TEST_F(GlDraw, WhatShadersWroteIsOrderedBeforeAllThatReadsIt) {
  static GLbitfield ordered;
  ordered = 0;
  const auto real = epoxy_glMemoryBarrier;
  epoxy_glMemoryBarrier = [](GLbitfield barriers) { ordered |= barriers; };
  shader_memory_barrier();
  epoxy_glMemoryBarrier = real;
  for (const GLbitfield barrier :
       {GL_SHADER_STORAGE_BARRIER_BIT, GL_COMMAND_BARRIER_BIT, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT,
        GL_FRAMEBUFFER_BARRIER_BIT, GL_TEXTURE_FETCH_BARRIER_BIT, GL_BUFFER_UPDATE_BARRIER_BIT})
    EXPECT_NE(ordered & barrier, 0u) << barrier;
}

}  // namespace
}  // namespace ssphh::gl
