/// Textures, samplers, volumes and buffers, as shaders see them.

#include <array>
#include <vector>

#include <glm/gtc/packing.hpp>
#include <gmock/gmock.h>

#include <ssphh/gl/draw.h>
#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/texture.h>
#include <ssphh/gl/volume.h>

#include "shaders.h"

namespace ssphh::gl {
namespace {

using testing::ElementsAre;

using GlResources = WithShaders;

TEST_F(GlResources, RectangleOfATextureIsUploadedWhereItIsTold) {
  Texture image(Format::r32f, 4, 3);
  image.upload(bytes(floats(12, 0)));
  image.upload_rect(bytes(floats(2, 50)), 1, 2, 2, 1);
  std::vector<float> back(12);
  image.read(back, 1);
  EXPECT_THAT(back, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 50, 51, 11));
}

TEST_F(GlResources, BytesOfATextureAreThoseOfItsTexelsInAllLayers) {
  EXPECT_EQ(Texture(Format::rgba8, 5, 3).bytes(), 60u);
  EXPECT_EQ(Texture(Format::rg32f, 5, 3, 2).bytes(), 240u);
  for (const auto& [format, size] : {std::pair(Format::rgba8, 4),
                                     {Format::srgb8_alpha8, 4},
                                     {Format::r16f, 4},
                                     {Format::rgba16f, 16},
                                     {Format::r32f, 4},
                                     {Format::rg32f, 8},
                                     {Format::rgba32f, 16},
                                     {Format::rg32ui, 8},
                                     {Format::rgba32ui, 16},
                                     {Format::depth32f, 4},
                                     {Format::depth32f_stencil8, 8}})
    EXPECT_EQ(bytes_per_texel(format), static_cast<std::size_t>(size)) << static_cast<int>(format);
}

TEST_F(GlResources, SrgbTexelsAreReadAsLinearLight) {
  Texture encoded(Format::srgb8_alpha8, 1, 1), plain(Format::rgba8, 1, 1);
  const std::vector<std::uint8_t> texel = {188, 99, 255, 51};
  encoded.upload(bytes(texel));
  plain.upload(bytes(texel));
  encoded.bind(1);
  plain.bind(2);
  const auto seen = computed(2,
                             "layout(binding = 1) uniform sampler2D encoded;\n"
                             "layout(binding = 2) uniform sampler2D plain;",
                             "i == 0 ? texelFetch(encoded, ivec2(0), 0) : texelFetch(plain, ivec2(0), 0)");
  const auto linear = [](int v) { return std::pow((v / 255.0 + 0.055) / 1.055, 2.4); };
  EXPECT_NEAR(seen[0].x, linear(188), 0.002);  // drivers may look it up in 8 bits
  EXPECT_NEAR(seen[0].y, linear(99), 0.002);
  EXPECT_NEAR(seen[0].z, 1, 1e-6);
  EXPECT_NEAR(seen[0].w, 0.2, 1e-6);
  EXPECT_NEAR(seen[1].x, 188 / 255.0, 1e-6);
}

// Texels 0, 1, 2, 3 in both directions, read beyond the end.
TEST_F(GlResources, SamplerWrapsEachDirectionInItsOwnWay) {
  std::vector<float> texels;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) texels.insert(texels.end(), {static_cast<float>(x), static_cast<float>(y)});
  Texture image(Format::rg32f, 4, 4);
  image.upload(bytes(texels));
  image.bind(1);
  const auto beyond = [&](Address u, Address v) {
    const Sampler sampler(u, v, true);
    sampler.bind(1);
    const auto seen = computed(1, "layout(binding = 1) uniform sampler2D image;",
                               "textureLod(image, vec2(1.375, 1.375), 0.0)");  // texel 5.5
    Sampler::unbind(1);
    return vec2(seen[0]);
  };
  EXPECT_EQ(beyond(Address::repeat, Address::mirror), vec2(1, 2));
  EXPECT_EQ(beyond(Address::clamp, Address::repeat), vec2(3, 1));
  EXPECT_EQ(beyond(Address::mirror, Address::clamp), vec2(2, 3));
}

TEST_F(GlResources, TextureIsFilteredWhenItIsToldTo) {
  Texture image(Format::r32f, 2, 1);
  image.upload(bytes(std::vector<float>{1, 5}));
  image.bind(1);
  const auto between = [&] {
    return computed(1, "layout(binding = 1) uniform sampler2D image;",
                    "textureLod(image, vec2(0.625, 0.5), 0.0)")[0]
        .x;
  };
  EXPECT_EQ(between(), 5);
  image.set_filter(true);
  EXPECT_NEAR(between(), 4, 1.0 / 64) << "three quarters of the way; weights may have 8 bits";
}

TEST_F(GlResources, MipmapsGoDownToOneTexelOfTheLongerSide) {
  Texture image(Format::r32f, 8, 2, 0, true);
  image.upload(bytes(std::vector<float>(16, 3)));
  image.generate_mipmaps();
  image.bind(1);
  const auto levels = computed(1, "layout(binding = 1) uniform sampler2D image;",
                               "textureQueryLevels(image), texelFetch(image, ivec2(0), 3).r, 0, 0");
  EXPECT_EQ(levels[0].x, 4);
  EXPECT_EQ(levels[0].y, 3);
}

TEST_F(GlResources, VolumeIsZeroAndItsBoxesAreUploadedWhereTheyAreTold) {
  EXPECT_EQ(Volume().size(), ivec3(0));
  EXPECT_EQ(Volume().bytes(), 0u);
  Volume volume({3, 4, 2});
  EXPECT_EQ(volume.bytes(), 3u * 4 * 2 * 8);
  std::vector<std::uint64_t> box;
  for (int i = 0; i < 2; ++i) {
    const auto n = static_cast<float>(i);
    box.push_back(glm::packHalf4x16(vec4(1 + n, 10 + n, 20 + n, 30 + n)));
  }
  volume.upload_box(box, {1, 2, 1}, {1, 2, 1});
  volume.bind(1);
  const auto seen = computed(3, "layout(binding = 1) uniform sampler3D volume;",
                             "texelFetch(volume, ivec3(1, 1 + i, 1), 0)");
  EXPECT_THAT(seen, ElementsAre(vec4(0), vec4(1, 10, 20, 30), vec4(2, 11, 21, 31)));
  volume.clear();
  EXPECT_EQ(computed(1, "layout(binding = 1) uniform sampler3D volume;",
                     "texelFetch(volume, ivec3(1, 2, 1), 0)")[0],
            vec4(0));
}

TEST_F(GlResources, BufferIsChangedFromAnElementOnAndKeptWhileItIsLargeEnough) {
  const std::vector<float> all = floats(4, 1);
  Buffer buffer{std::span<const float>(all)};
  const unsigned id = buffer.id();
  buffer.update(std::span<const float>(std::array{70.0f}), 2);
  buffer.reserve(16);
  EXPECT_EQ(buffer.id(), id);
  buffer.bind_storage(3);
  const auto seen =
      computed(4, "layout(std430, binding = 3) readonly buffer Numbers { float numbers[]; };", "numbers[i]");
  EXPECT_THAT((std::vector<float>{seen[0].x, seen[1].x, seen[2].x, seen[3].x}), ElementsAre(1, 2, 70, 4));
  buffer.reserve(17);
  EXPECT_EQ(buffer.size(), 17u);
}

TEST_F(GlResources, UniformRangeBeginsAtItsOffset) {
  const std::vector<float> all = floats(128, 0);
  const Buffer buffer{std::span<const float>(all)};
  buffer.bind_uniform_range(2, 256, 16);
  const auto seen = computed(1, "layout(std140, binding = 2) uniform Part { vec4 part; };", "part");
  EXPECT_EQ(seen[0], vec4(64, 65, 66, 67));
}

TEST_F(GlResources, PixelsAreReadFromTheTopAndOpaque) {
  Texture image(Format::rgba8, 2, 4);
  std::vector<std::uint8_t> texels;
  for (std::uint8_t i = 0; i < 32; ++i) texels.push_back(static_cast<std::uint8_t>(8 * i));
  image.upload(bytes(texels));
  const Framebuffer target(std::array<const Texture*, 1>{&image}, nullptr);
  const auto pixels = read_pixels(target.id(), {1, 0, 1, 4});
  EXPECT_THAT(pixels,
              ElementsAre(224, 232, 240, 255, 160, 168, 176, 255, 96, 104, 112, 255, 32, 40, 48, 255));
}

}  // namespace
}  // namespace ssphh::gl
