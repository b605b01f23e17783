/// What the driver is asked for: formats, limits, filters and memory.

#include <cmath>

#include <epoxy/gl.h>
#include <glm/gtc/packing.hpp>
#include <gmock/gmock.h>

#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/volume.h>

#include "error_message.h"
#include "shaders.h"

namespace ssphh::gl {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

class GlTexture : public WithShaders {
 protected:
  void TearDown() override {
    if (!IsSkipped()) gl().forget_errors();
  }
  static int integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
  }
  static int of_level(unsigned texture, int level, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, level, name, &value);
    return value;
  }
  static int of_texture(unsigned texture, GLenum name) {
    GLint value = 0;
    glGetTextureParameteriv(texture, name, &value);
    return value;
  }
};

TEST_F(GlTexture, HasTheFormatItIsMadeOf) {
  for (const auto& [format, internal] : {std::pair(Format::rgba8, GL_RGBA8),
                                         {Format::srgb8_alpha8, GL_SRGB8_ALPHA8},
                                         {Format::r16f, GL_R16F},
                                         {Format::rgba16f, GL_RGBA16F},
                                         {Format::r32f, GL_R32F},
                                         {Format::rg32f, GL_RG32F},
                                         {Format::rgba32f, GL_RGBA32F},
                                         {Format::rg32ui, GL_RG32UI},
                                         {Format::rgba32ui, GL_RGBA32UI},
                                         {Format::depth32f, GL_DEPTH_COMPONENT32F},
                                         {Format::depth32f_stencil8, GL_DEPTH32F_STENCIL8}}) {
    const Texture image(format, 3, 2);
    EXPECT_EQ(of_level(image.id(), 0, GL_TEXTURE_INTERNAL_FORMAT), internal);
    EXPECT_EQ(image.format(), format);
  }
  EXPECT_THROW(bytes_per_texel(static_cast<Format>(99)), Error);
}

TEST_F(GlTexture, OfNothingHasNoSize) {
  const Rect rect;
  EXPECT_TRUE(rect.x == 0 && rect.y == 0 && rect.width == 0 && rect.height == 0);
  const Texture none;
  EXPECT_EQ(none.id(), 0u);
  EXPECT_EQ(none.width(), 0);
  EXPECT_EQ(none.height(), 0);
  EXPECT_EQ(none.layers(), 0);
  EXPECT_EQ(none.format(), Format::rgba8);
  EXPECT_EQ(none.bytes(), 0u);
}

TEST_F(GlTexture, WhatIsUploadedIsReadInEveryFormat) {
  const auto seen = [](const Texture& image, const char* kind) {
    image.bind(1);
    return computed(1, "layout(binding = 1) uniform " + std::string(kind) + "sampler2D image;",
                    "texelFetch(image, ivec2(1, 0), 0)")[0];
  };
  const std::vector<float> numbers = floats(8, 1);
  for (const auto& [format, channels] : {std::pair(Format::r16f, 1),
                                         {Format::r32f, 1},
                                         {Format::depth32f, 1},
                                         {Format::rg32f, 2},
                                         {Format::rgba16f, 4},
                                         {Format::rgba32f, 4}}) {
    Texture image(format, 2, 1);
    const float scale = format == Format::depth32f ? 1 / 16.0f : 1;
    std::vector<float> texels;
    for (int i = 0; i < 2 * channels; ++i) texels.push_back(scale * numbers[i]);
    image.upload(bytes(texels));
    vec4 expected(0, 0, 0, 1);
    for (int i = 0; i < channels; ++i) expected[i] = texels[channels + i];
    EXPECT_EQ(seen(image, ""), expected) << static_cast<int>(format);
  }
  const std::vector<unsigned> whole = {1, 2, 3, 4, 5, 6, 7, 8};
  Texture two(Format::rg32ui, 2, 1), four(Format::rgba32ui, 2, 1);
  two.upload(bytes(whole).first(16));
  four.upload(bytes(whole));
  EXPECT_EQ(seen(two, "u"), vec4(3, 4, 0, 1));
  EXPECT_EQ(seen(four, "u"), vec4(5, 6, 7, 8));
}

TEST_F(GlTexture, IsAsLargeAsTheDriverAllowsAndNoLarger) {
  const int most = integer(GL_MAX_TEXTURE_SIZE), layers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
  EXPECT_EQ(Texture(Format::r16f, most, 1).width(), most);
  EXPECT_EQ(Texture(Format::r16f, 1, most).height(), most);
  EXPECT_EQ(Texture(Format::r16f, 1, 1, layers).layers(), layers);
  const auto refusal = [](int width, int height, int count) {
    return test::message_of([&] { Texture(Format::r16f, width, height, count); });
  };
  const auto message = [&](int width, int height, int count) {
    return "OpenGL: a texture of " + std::to_string(width) + "×" + std::to_string(height) + ", " +
           std::to_string(count) + " layers is more than the driver's " + std::to_string(most) + ", " +
           std::to_string(layers);
  };
  EXPECT_EQ(refusal(most + 1, 2, 0), message(most + 1, 2, 0));
  EXPECT_EQ(refusal(2, most + 1, 3), message(2, most + 1, 3));
  EXPECT_EQ(refusal(1, 2, layers + 1), message(1, 2, layers + 1));
  EXPECT_EQ(refusal(0, 1, 0), "texture: its size must be over 0");
  EXPECT_EQ(refusal(1, 0, 0), "texture: its size must be over 0");
}

TEST_F(GlTexture, HasOneLevelUnlessMipmapsAreAskedFor) {
  const auto levels = [](const Texture& image) {
    return of_texture(image.id(), GL_TEXTURE_IMMUTABLE_LEVELS);
  };
  EXPECT_EQ(levels(Texture(Format::r32f, 8, 8)), 1);
  EXPECT_EQ(levels(Texture(Format::r32f, 8, 8, 2)), 1);
  EXPECT_EQ(levels(Texture(Format::r32f, 2, 9, 0, true)), 4);
  EXPECT_EQ(levels(Texture(Format::r32f, 1, 1, 0, true)), 1);
  EXPECT_EQ(levels(Texture(Format::r32f, 16, 2, 3, true)), 5);
  const Texture array(Format::r32f, 5, 3, 2);
  EXPECT_EQ(of_level(array.id(), 0, GL_TEXTURE_WIDTH), 5);
  EXPECT_EQ(of_level(array.id(), 0, GL_TEXTURE_HEIGHT), 3);
  EXPECT_EQ(of_level(array.id(), 0, GL_TEXTURE_DEPTH), 2);
}

TEST_F(GlTexture, IsClampedAndNearestUntilItIsToldToFilter) {
  const auto filters = [](const Texture& image) {
    return std::array{of_texture(image.id(), GL_TEXTURE_MIN_FILTER),
                      of_texture(image.id(), GL_TEXTURE_MAG_FILTER),
                      of_texture(image.id(), GL_TEXTURE_WRAP_S), of_texture(image.id(), GL_TEXTURE_WRAP_T)};
  };
  Texture plain(Format::r32f, 4, 4), mipmapped(Format::r32f, 4, 4, 0, true);
  for (Texture* image : {&plain, &mipmapped}) {
    EXPECT_THAT(filters(*image), ElementsAre(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE));
    image->set_filter(true);
    EXPECT_THAT(filters(*image), ElementsAre(image == &plain ? GL_LINEAR : GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR,
                                             GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE));
    image->set_filter(false);
    EXPECT_THAT(filters(*image), ElementsAre(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE));
  }
}

TEST_F(GlTexture, RectangleMayTouchEveryEdgeAndAnyLayer) {
  Texture image(Format::r32f, 3, 2, 2);
  image.upload(bytes(std::vector<float>(6, 0)), 0);
  image.upload(bytes(std::vector<float>(6, 0)), 1);
  image.upload_rect(bytes(floats(2, 1)), 1, 1, 2, 1, 1);
  image.upload_rect(bytes(floats(2, 3)), 0, 0, 1, 2, 0);
  image.upload_rect({}, 3, 2, 0, 0, 1);
  EXPECT_THAT(floats_of(image), ElementsAre(3, 0, 0, 4, 0, 0, 0, 0, 0, 0, 1, 2));
  const auto refused = [&](int x, int y, int width, int height, int layer) {
    const std::vector<float> texels(static_cast<std::size_t>(std::max(width, 0) * std::max(height, 0)));
    return test::message_of([&] { image.upload_rect(bytes(texels), x, y, width, height, layer); }) ==
           "texture: the rectangle does not lie inside";
  };
  EXPECT_TRUE(refused(-1, 0, 2, 1, 0));
  EXPECT_TRUE(refused(0, -1, 1, 2, 0));
  EXPECT_TRUE(refused(2, 0, 2, 1, 0));
  EXPECT_TRUE(refused(0, 1, 1, 2, 0));
  EXPECT_TRUE(refused(1, 1, -1, 1, 0));
  EXPECT_TRUE(refused(1, 1, 1, -1, 0));
  EXPECT_TRUE(refused(0, 0, 1, 1, -1));
  EXPECT_TRUE(refused(0, 0, 1, 1, 2));
}

TEST_F(GlTexture, ReadingTakesAsManyFloatsAsItHasTexelsAndChannels) {
  Texture image(Format::rgba32f, 2, 1, 2), depth(Format::depth32f, 2, 1);
  image.upload(bytes(floats(8, 0)), 0);
  image.upload(bytes(floats(8, 8)), 1);
  depth.upload(bytes(std::vector<float>{0.25f, 0.5f}));
  std::vector<float> two(8), three(12);
  image.read(two, 2);
  EXPECT_THAT(two, ElementsAre(0, 1, 4, 5, 8, 9, 12, 13));
  image.read(three, 3);
  EXPECT_THAT(three, ElementsAre(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14));
  std::vector<float> depths(2);
  depth.read(depths, 4);
  EXPECT_THAT(depths, ElementsAre(0.25f, 0.5f)) << "which have one channel";
  EXPECT_THAT(test::message_of([&] { image.read(std::span(three).first(11), 3); }),
              StartsWith("texture: there is no room"));
  EXPECT_THAT(test::message_of([&] { depth.read(std::span(depths).first(1), 1); }),
              StartsWith("texture: there is no room"));
  EXPECT_THAT(test::message_of([&] { image.read(three, 0); }), "texture: a texel has 1 to 4 channels");
}

TEST_F(GlTexture, LayersOfAnImageAreWrittenByShaders) {
  const Texture image(Format::rgba32f, 2, 1, 3);
  image.bind_image(4);
  computed(3,
           "layout(rgba32f, binding = 4) uniform image2DArray layers;\n"
           "vec4 store(int i) { imageStore(layers, ivec3(1, 0, i), vec4(i + 1)); return vec4(0); }",
           "store(i)");
  const std::vector<vec4> texels = texels_of(image);
  EXPECT_EQ(texels[1], vec4(1));
  EXPECT_EQ(texels[3], vec4(2));
  EXPECT_EQ(texels[5], vec4(3));
}

TEST_F(GlTexture, SamplerFiltersAsItIsTold) {
  const auto parameters = [](const Sampler& sampler) {
    sampler.bind(3);
    glActiveTexture(GL_TEXTURE3);
    const auto id = static_cast<unsigned>(integer(GL_SAMPLER_BINDING));
    glActiveTexture(GL_TEXTURE0);
    Sampler::unbind(3);
    std::vector<int> found;
    for (const GLenum name :
         {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
      GLint value = 0;
      glGetSamplerParameteriv(id, name, &value);
      found.push_back(value);
    }
    float anisotropy = 0;
    glGetSamplerParameterfv(id, GL_TEXTURE_MAX_ANISOTROPY_EXT, &anisotropy);
    found.push_back(static_cast<int>(anisotropy));
    return found;
  };
  using enum Address;
  EXPECT_THAT(parameters(Sampler(repeat, mirror, false)),
              ElementsAre(GL_REPEAT, GL_MIRRORED_REPEAT, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, 1));
  EXPECT_THAT(parameters(Sampler(clamp, repeat, true, 8)),
              ElementsAre(GL_CLAMP_TO_EDGE, GL_REPEAT, GL_NEAREST, GL_NEAREST, 1));
  if (!epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) GTEST_SKIP() << "no anisotropic filter";
  EXPECT_THAT(parameters(Sampler(mirror, clamp, false, 8)),
              ElementsAre(GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, 8));
}

TEST_F(GlTexture, VolumeIsFilteredAndClamped) {
  Volume volume({2, 2, 2});
  std::vector<std::uint64_t> texels;
  for (int i = 0; i < 8; ++i) texels.push_back(glm::packHalf4x16(vec4(i & 1, i >> 1 & 1, i >> 2, 1)));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  volume.upload_box(texels, {0, 0, 0}, {2, 2, 2});
  volume.bind(1);
  const auto seen = computed(2, "layout(binding = 1) uniform sampler3D volume;",
                             "textureLod(volume, i == 0 ? vec3(0.375, 0.5, 0.625) : vec3(9, -9, 9), 0.0)");
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(seen[0][axis], 0.25f + 0.25f * static_cast<float>(axis), 1 / 64.0f);
  EXPECT_EQ(seen[1], vec4(1, 0, 1, 1));
}

TEST_F(GlTexture, VolumeIsAsLargeAsTheDriverAllowsAndNoLarger) {
  const int most = integer(GL_MAX_3D_TEXTURE_SIZE);
  for (int axis = 0; axis < 3; ++axis) {
    ivec3 size(1, 2, 3);
    size[axis] = most;
    EXPECT_EQ(Volume(size).size(), size);
    size[axis] = most + 1;
    EXPECT_EQ(test::message_of([&] { const Volume refused(size); }),
              "OpenGL: a volume of " + std::to_string(size.x) + "×" + std::to_string(size.y) + "×" +
                  std::to_string(size.z) + " texels is more than the driver's " + std::to_string(most));
    size[axis] = 0;
    EXPECT_EQ(test::message_of([&] { const Volume refused(size); }),
              "volume texture: its size must be over 0");
  }
}

TEST_F(GlTexture, BoxOfAVolumeMayTouchEveryEdge) {
  Volume volume({2, 3, 4});
  const std::vector<std::uint64_t> one(1), all(24);
  EXPECT_NO_THROW(volume.upload_box(all, {0, 0, 0}, {2, 3, 4}));
  EXPECT_NO_THROW(volume.upload_box(one, {1, 2, 3}, {1, 1, 1}));
  for (int axis = 0; axis < 3; ++axis) {
    for (const int at : {-1, volume.size()[axis]}) {
      ivec3 corner(0);
      corner[axis] = at;
      EXPECT_EQ(test::message_of([&] { volume.upload_box(one, corner, ivec3(1)); }),
                "volume texture: the box does not lie inside");
    }
  }
}

TEST_F(GlTexture, MoreMemoryThanThereIsIsRefused) {
  EXPECT_EQ(test::message_of([] { const Buffer refused(std::size_t{1} << 46); }),
            "OpenGL: no memory for a buffer of 67108864 MiB");
}

TEST_F(GlTexture, BufferIsOfItsSizeAndEmptyOnesCanBeBound) {
  EXPECT_EQ(Buffer().size(), 0u);
  EXPECT_EQ(Buffer().id(), 0u);
  for (const std::size_t size : {0u, 1u, 40u}) {
    const Buffer buffer(size);
    EXPECT_EQ(buffer.size(), size);
    buffer.bind_storage(2);
    buffer.bind_uniform(3);
    GLint64 bytes = 0;
    glGetNamedBufferParameteri64v(buffer.id(), GL_BUFFER_SIZE, &bytes);
    EXPECT_EQ(bytes, size == 0 ? 16 : static_cast<GLint64>(size));
  }
  EXPECT_NO_THROW(gl().throw_on_error("binding"));
}

TEST_F(GlTexture, BufferThatIsReservedIsMadeOnceAndTakesBytesUpToItsEnd) {
  Buffer buffer;
  buffer.reserve(0);
  EXPECT_NE(buffer.id(), 0u);
  buffer.reserve(8);
  EXPECT_EQ(buffer.size(), 8u);
  const unsigned id = buffer.id();
  buffer.reserve(7);
  EXPECT_EQ(buffer.id(), id);
  buffer.update(std::span<const float>(std::array{1.0f, 2.0f}));
  buffer.update(std::span<const float>(std::array{5.0f}), 1);
  buffer.update(std::span<const float>(), 2);
  EXPECT_THROW(buffer.update(std::span<const float>(std::array{5.0f}), 2), Error);
  EXPECT_THROW(buffer.update_bytes(9, {}), Error);
  std::array<float, 2> back{};
  glGetNamedBufferSubData(buffer.id(), 0, 8, back.data());
  EXPECT_THAT(back, ElementsAre(1, 5));
}

TEST_F(GlTexture, BufferIsReadThroughTheBindingItIsGiven) {
  const Buffer first{std::span<const float>(std::array{1.0f, 2.0f, 3.0f, 4.0f})},
      second{std::span<const float>(std::array{5.0f, 6.0f, 7.0f, 8.0f})};
  first.bind_uniform(4);
  second.bind_uniform(5);
  EXPECT_EQ(computed(1,
                     "layout(std140, binding = 4) uniform A { vec4 a; };\n"
                     "layout(std140, binding = 5) uniform B { vec4 b; };",
                     "a * 10 + b")[0],
            vec4(15, 26, 37, 48));
}

}  // namespace
}  // namespace ssphh::gl
