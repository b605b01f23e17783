/// What framebuffers take, and where clearing and drawing go.

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "error_message.h"
#include "shaders.h"

namespace ssphh::gl {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

class GlFramebuffer : public WithShaders {
 protected:
  void TearDown() override {
    if (!IsSkipped()) gl().throw_on_error("after the test");
  }
  /// Red of texel (0, 0) of each level.
  static std::vector<float> levels_of(const Texture& texture, int count, int layer = -1) {
    texture.bind(1);
    const std::vector<vec4> texels =
        layer < 0 ? computed(count, "layout(binding = 1) uniform sampler2D image;",
                             "texelFetch(image, ivec2(0), i)")
                  : computed(count, "layout(binding = 1) uniform sampler2DArray image;",
                             "texelFetch(image, ivec3(0, 0, " + std::to_string(layer) + "), i)");
    std::vector<float> reds;
    for (const vec4& texel : texels) reds.push_back(texel.x);
    return reds;
  }
};

TEST_F(GlFramebuffer, TexelsAreCopiedAsTheyAreFromLayerToLayer) {
  const Texture from(Format::depth32f, 4, 2, 3), to(Format::depth32f, 2, 4, 2);
  for (int layer = 0; layer < 3; ++layer) {
    const Framebuffer target(from, layer);
    bind_framebuffer(target.id(), {0, 0, 4, 2});
    for (int x = 0; x < 4; ++x) clear_depth({x, 1, 1, 1}, 0.0625f * static_cast<float>(layer * 4 + x));
  }
  for (int layer = 0; layer < 2; ++layer) {
    const Framebuffer target(to, layer);
    bind_framebuffer(target.id(), {0, 0, 2, 4});
    clear_depth({0, 0, 2, 4}, 1);
  }
  copy_texels({from, 2, 1, 1}, {to, 1, 0, 0}, 2, 1);
  std::vector<float> depths(16);
  to.read(depths, 1);
  EXPECT_THAT(depths, ElementsAre(1, 1, 1, 1, 1, 1, 1, 1, 0.0625f * 9, 0.0625f * 10, 1, 1, 1, 1, 1, 1));

  Texture color(Format::rgba32f, 2, 1);
  const Texture other(Format::rgba32f, 1, 1);
  const std::vector<vec4> texels{vec4(1, 2, 3, 4), vec4(5, 6, 7, 8)};
  color.upload(std::as_bytes(std::span(texels)));
  copy_texels({color, 0, 1, 0}, {other}, 1, 1);
  EXPECT_THAT(texels_of(other), ElementsAre(vec4(5, 6, 7, 8)));
}

TEST_F(GlFramebuffer, EachOfEightTexturesIsClearedAndDrawnIntoByItsNumber) {
  std::vector<Texture> textures;
  std::vector<const Texture*> all;
  std::string outputs, body;
  for (int i = 0; i < 8; ++i) {
    textures.emplace_back(Format::rgba32f, 1, 1);
    const std::string n = std::to_string(i);
    outputs += "layout(location = " + n + ") out vec4 o" + n + ";\n";
    body += "o" + n + " = vec4(" + n + ", 5, 6, 7);\n";
  }
  for (const Texture& texture : textures) all.push_back(&texture);
  const Framebuffer target(all, nullptr);
  bind_framebuffer(target.id(), {0, 0, 1, 1});
  apply({.color_write = false});
  for (int i = 0; i < 8; ++i) clear_color(i, 10 + static_cast<float>(i), 2, 3, 4);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_THAT(texels_of(textures[i]), ElementsAre(vec4(10 + static_cast<float>(i), 2, 3, 4)));
  const std::string fragment = "#version 450 core\n" + outputs + "void main() { " + body + " }";
  const std::array<ShaderFiles::Embedded, 2> table{
      {{"whole.vert",
        "#version 450 core\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1,"
        " gl_VertexID == 2 ? 3 : -1, 0, 1); }"},
       {"eight.frag", fragment}}};
  const Program program(ShaderFiles(table), "whole.vert", "eight.frag");
  program.use();
  apply({});
  const VertexArray nothing;
  nothing.bind();
  draw_triangles(3);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_THAT(texels_of(textures[i]), ElementsAre(vec4(static_cast<float>(i), 5, 6, 7)));
}

TEST_F(GlFramebuffer, WholeNumbersAreClearedExactly) {
  const Texture plain(Format::rgba32f, 1, 1), numbers(Format::rgba32ui, 1, 1);
  const Framebuffer target(std::array<const Texture*, 2>{&plain, &numbers}, nullptr);
  bind_framebuffer(target.id(), {0, 0, 1, 1});
  apply({.color_write = false});
  clear_color_uint(1, 4000000001u, 2, 3, 70000);
  numbers.bind(1);
  const auto same = computed(1, "layout(binding = 1) uniform usampler2D numbers;",
                             "equal(texelFetch(numbers, ivec2(0), 0), uvec4(4000000001u, 2, 3, 70000))");
  EXPECT_EQ(same[0], vec4(1));
}

TEST_F(GlFramebuffer, DepthIsClearedWithinItsRectangleWhateverTheMask) {
  const Texture depth(Format::depth32f, 4, 3);
  const Framebuffer target({}, &depth);
  bind_framebuffer(target.id(), {0, 0, 4, 3});
  clear_depth({0, 0, 4, 3}, 0.25f);
  apply({.depth = Depth::off});  // its writing is off as well
  clear_depth({1, 0, 2, 2}, 0.75f);
  EXPECT_THAT(floats_of(depth),
              ElementsAre(.25f, .75f, .75f, .25f, .25f, .75f, .75f, .25f, .25f, .25f, .25f, .25f));
  EXPECT_FALSE(glIsEnabled(GL_SCISSOR_TEST));
}

TEST_F(GlFramebuffer, OneLayerOfAnArrayIsDrawnInto) {
  Texture colors(Format::r32f, 1, 1, 3);
  for (int layer = 0; layer < 3; ++layer) colors.upload(bytes(floats(1, 5)), layer);
  const Framebuffer one(colors, 1);
  bind_framebuffer(one.id(), {0, 0, 1, 1});
  clear_color(0, 7, 0, 0, 0);
  EXPECT_THAT(floats_of(colors), ElementsAre(5, 7, 5));

  const Texture depths(Format::depth32f, 1, 1, 3);
  for (int layer = 0; layer < 3; ++layer) {
    const Framebuffer each(depths, layer);
    bind_framebuffer(each.id(), {0, 0, 1, 1});
    clear_depth({0, 0, 1, 1}, 0.25f * static_cast<float>(layer));
  }
  EXPECT_THAT(floats_of(depths), ElementsAre(0, 0.25f, 0.5f));
}

TEST_F(GlFramebuffer, OneLevelOfAMipmapIsDrawnInto) {
  for (const int layers : {0, 2}) {
    Texture image(Format::r32f, 4, 4, layers, true);
    for (int layer = 0; layer < std::max(layers, 1); ++layer) image.upload(bytes(floats(16, 0)), layer);
    image.generate_mipmaps();
    const int layer = layers > 0 ? 1 : 0;
    for (int level = 0; level < 3; ++level) {
      const Framebuffer target(image, layer, level);
      bind_framebuffer(target.id(), {0, 0, 4 >> level, 4 >> level});
      clear_color(0, 20 + static_cast<float>(level), 0, 0, 0);
    }
    EXPECT_THAT(levels_of(image, 3, layers > 0 ? 1 : -1), ElementsAre(20, 21, 22));
    if (layers > 0) {
      EXPECT_THAT(levels_of(image, 3, 0), ElementsAre(0, 2.5f, 7.5f)) << "of 0 to 15";
    }
    const Framebuffer whole(image, layer);
    bind_framebuffer(whole.id(), {0, 0, 4, 4});
    clear_color(0, 30, 0, 0, 0);
    EXPECT_THAT(levels_of(image, 2, layers > 0 ? 1 : -1), ElementsAre(30, 21)) << "level 0 unless told";
  }
}

TEST_F(GlFramebuffer, RefusalSaysWhatTheDriverAnswered) {
  const Texture color(Format::rgba8, 2, 2), depth(Format::depth32f, 2, 2);
  const auto refusal =
      AllOf(HasSubstr("OpenGL"), HasSubstr("the driver refuses a framebuffer (status 0x8cd6)"));
  EXPECT_THAT(test::message_of([&] { Framebuffer(std::array<const Texture*, 1>{&depth}, nullptr); }),
              refusal);
  EXPECT_THAT(test::message_of([&] { Framebuffer({}, &color); }), refusal);
}

TEST_F(GlFramebuffer, DrawingGoesIntoTheViewportOfTheBoundOne) {
  const Texture first(Format::rgba32f, 4, 3), second(Format::rgba32f, 4, 3);
  const Framebuffer one(std::array<const Texture*, 1>{&first}, nullptr),
      other(std::array<const Texture*, 1>{&second}, nullptr);
  for (const Framebuffer* target : {&other, &one}) {
    bind_framebuffer(target->id(), {1, 2, 3, 1});
    clear_color(0, 0, 0, 0, 0);
  }
  apply_conventions();
  apply({});
  Program program = whole_picture();
  program.set("color", vec4(1, 2, 3, 4));
  program.use();
  const VertexArray nothing;
  nothing.bind();
  draw_triangles(3);
  std::vector<float> drawn;
  for (const vec4& texel : texels_of(first)) drawn.push_back(texel.w);
  EXPECT_THAT(drawn, ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 4, 4));
  EXPECT_THAT(texels_of(second), Each(vec4(0)));
}

// Rows of one pixel are the ones that a packing of 8 bytes would move.
TEST_F(GlFramebuffer, ColoursAreCopiedIntoASmallerOneUnfiltered) {
  Texture large(Format::rgba32f, 6, 4), small(Format::rgba32f, 2, 2);
  std::vector<vec4> texels;
  for (int i = 0; i < 24; ++i) texels.emplace_back(i, i % 6, 2, 1);
  large.upload(std::as_bytes(std::span(texels)));
  const Texture *const from[] = {&large}, *const to[] = {&small};
  const Framebuffer source(from, nullptr), target(to, nullptr);
  copy_colors(source, {0, 0, 6, 4}, target, {0, 0, 2, 2});
  std::vector<float> copied(16);
  small.read(copied, 4);
  // The middles of its texels are at x 1.5 and 4.5; y 1 and 3 lie between two rows each.
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(copied[4 * i + 1], i % 2 ? 4 : 1);
    EXPECT_EQ(std::floor(copied[4 * i] / 12), static_cast<float>(i / 2));
    EXPECT_EQ(copied[4 * i + 2], 2);
  }
}

TEST_F(GlFramebuffer, OddNumberOfRowsIsReadWhateverThePacking) {
  Texture image(Format::rgba8, 3, 3);
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 9; ++i)
    for (int c = 0; c < 4; ++c) texels.push_back(static_cast<std::uint8_t>(10 * i + c));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  image.upload(bytes(texels));
  const Framebuffer layer(image, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 8);
  EXPECT_THAT(read_pixels(layer.id(), {2, 0, 1, 3}),
              ElementsAre(80, 81, 82, 255, 50, 51, 52, 255, 20, 21, 22, 255));
  EXPECT_THAT(read_pixels(layer.id(), {0, 1, 2, 1}), ElementsAre(30, 31, 32, 255, 40, 41, 42, 255));
}

}  // namespace
}  // namespace ssphh::gl
