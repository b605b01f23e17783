// Blocks of BC6H as OpenGL reads them.

#include <vector>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/gl/context.h>
#include <ssphh/sh/bc6h.h>

namespace ssphh::realtime {
namespace {

TEST(Bc6h, OpenGlReadsTheSameOfEveryModeAndShape) {
  const gl::Context context = gl::Context::headless();
  constexpr int side = 64;  // blocks
  Pcg32 random(1);
  std::vector<sh::Bc6hBlock> blocks(side * side);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::byte& b : blocks[i]) b = static_cast<std::byte>(random.next());
    blocks[i][0] =
        (blocks[i][0] & std::byte(0xe0)) | static_cast<std::byte>(i % 32);  // each of the 32 numbers of modes
  }
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT, 4 * side, 4 * side);
  glCompressedTextureSubImage2D(texture, 0, 0, 0, 4 * side, 4 * side, GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT,
                                static_cast<GLsizei>(16 * blocks.size()), blocks.data());
  std::vector<vec3> texels(16 * blocks.size());
  glGetTextureImage(texture, 0, GL_RGB, GL_FLOAT, static_cast<GLsizei>(texels.size() * sizeof(vec3)),
                    texels.data());
  glDeleteTextures(1, &texture);
  ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const sh::Bc6hColours ours = sh::from_bc6h(blocks[i]);
    for (std::size_t t = 0; t < 16; ++t)
      ASSERT_EQ(texels[(4 * (i / side) + t / 4) * 4 * side + 4 * (i % side) + t % 4], ours[t])
          << "mode " << i % 32 << ", block " << i << ", texel " << t;
  }
}

}  // namespace
}  // namespace ssphh::realtime
