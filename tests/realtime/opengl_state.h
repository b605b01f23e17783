#pragma once
/// What shaders are given: the buffers and textures that are bound, read back from OpenGL.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace ssphh::test {

/// A word of a block as the number that it is: floats have exponents, the integers that shaders get have
/// none.
inline std::string word_text(std::uint32_t word) {
  if (word == 0x80000000) return "0";
  const auto exponent = word >> 23 & 0xff;
  const bool is_float = exponent != 0 && exponent != 0xff;
  return is_float ? fmt::format("{:.6g}", std::bit_cast<float>(word))
                  : fmt::format("{}", static_cast<int>(word));
}

/// What is not 0, four words a line after their place; blocks stand `stride` bytes apart, of which `used`
/// count.
inline std::string buffer_text(const std::string& name, unsigned buffer, std::size_t stride,
                               std::size_t used) {
  GLint64 size = 0;
  glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size);
  std::vector<std::uint32_t> words(static_cast<std::size_t>(size) / 4);
  glGetNamedBufferSubData(buffer, 0, size, words.data());
  std::string text = fmt::format("{}: {} bytes\n", name, size);
  for (std::size_t i = 0; i + 3 < words.size(); i += 4) {
    if (4 * i % stride >= used || (words[i] | words[i + 1] | words[i + 2] | words[i + 3]) == 0) continue;
    text += fmt::format("{}.{}", 4 * i / stride, 4 * i % stride / 16);
    for (std::size_t c = 0; c < 4; ++c) text += " " + word_text(words[i + c]);
    text += "\n";
  }
  return text;
}

/// The blocks bound for uniforms, of `strides` and lengths by binding; 0: left out.
inline std::string uniform_blocks(const std::vector<std::pair<std::size_t, std::size_t>>& blocks) {
  std::string text;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    GLint buffer = 0;
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, static_cast<GLuint>(i), &buffer);
    if (buffer != 0 && blocks[i].first > 0)
      text += buffer_text(fmt::format("block {}", i), static_cast<unsigned>(buffer), blocks[i].first,
                          blocks[i].second);
  }
  return text;
}

/// The texels of a level, summed by channel with weights of both signs that differ from texel to texel.
inline std::string texel_sums(unsigned texture, GLint level, const std::array<GLint, 3>& size, GLint format) {
  const bool whole = format == GL_RGBA32UI || format == GL_RG32UI;
  constexpr std::size_t channels = 4;
  std::vector<std::uint32_t> words(channels * static_cast<std::size_t>(size[0]) *
                                   static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]));
  glGetTextureImage(texture, level, whole ? GL_RGBA_INTEGER : GL_RGBA, whole ? GL_UNSIGNED_INT : GL_FLOAT,
                    static_cast<GLsizei>(4 * words.size()), words.data());
  std::array<double, 4> sums{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const double value = whole ? (words[i] & 0xffff) + 1e-3 * (words[i] >> 16)
                               : static_cast<double>(std::bit_cast<float>(words[i]));
    sums[i % channels] += value * std::cos(0.37 * static_cast<double>(i / channels % 9973));
  }
  std::string text;
  for (std::size_t c = 0; c < channels; ++c) text += fmt::format(" {:.6g}", sums[c]);
  return text;
}

/// Every texture that is bound to a unit: each level's size, and sums of what was uploaded. Maps of depth
/// have tiles that nobody draws.
inline std::string bound_textures(GLuint first, GLuint end) {
  std::string text;
  for (GLuint unit = first; unit < end; ++unit) {
    for (const GLenum target : {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_3D}) {
      GLint texture = 0, format = 0, levels = 0;
      glGetIntegeri_v(target, unit, &texture);
      if (texture == 0) continue;
      const auto id = static_cast<GLuint>(texture);
      glGetTextureParameteriv(id, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
      glGetTextureLevelParameteriv(id, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
      for (GLint level = 0; level < levels; ++level) {
        std::array<GLint, 3> size{};
        glGetTextureLevelParameteriv(id, level, GL_TEXTURE_WIDTH, &size[0]);
        glGetTextureLevelParameteriv(id, level, GL_TEXTURE_HEIGHT, &size[1]);
        glGetTextureLevelParameteriv(id, level, GL_TEXTURE_DEPTH, &size[2]);
        const bool drawn = format == GL_DEPTH_COMPONENT32F || format == GL_RG32F;
        text += fmt::format("unit {} level {}: {} x {} x {}, format {:x}{}\n", unit, level, size[0], size[1],
                            size[2], format, drawn ? "" : texel_sums(id, level, size, format));
      }
    }
  }
  return text;
}

}  // namespace ssphh::test
