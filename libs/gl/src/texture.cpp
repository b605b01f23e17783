#include <algorithm>
#include <bit>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/require.h>
#include <ssphh/gl/texture.h>

namespace ssphh::gl {
namespace {

struct FormatInfo {
  GLenum internal, external, type;
  std::size_t bytes;  ///< of a texel in memory, as uploaded
};

/// In the order of Format.
constexpr FormatInfo formats[] = {
    {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    {GL_R16F, GL_RED, GL_FLOAT, 4},
    {GL_RGBA16F, GL_RGBA, GL_FLOAT, 16},
    {GL_R32F, GL_RED, GL_FLOAT, 4},
    {GL_RG32F, GL_RG, GL_FLOAT, 8},
    {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16},
    {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8},
    {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16},
    {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4},
    {GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 8}};

const FormatInfo& info_of(Format format) {
  const auto i = static_cast<std::size_t>(format);
  require(i < std::size(formats), "texture format", "there is none of that number");
  return formats[i];
}

GLenum wrap_of(Address address) {
  return address == Address::repeat   ? GL_REPEAT
         : address == Address::mirror ? GL_MIRRORED_REPEAT
                                      : GL_CLAMP_TO_EDGE;
}

}  // namespace

void delete_texture(unsigned id) {
  glDeleteTextures(1, &id);
}
void delete_sampler(unsigned id) {
  glDeleteSamplers(1, &id);
}

std::size_t bytes_per_texel(Format format) {
  return info_of(format).bytes;
}

Texture::Texture(Format format, int width, int height, int layers, bool mipmaps)
    : format_(format), width_(width), height_(height), layers_(layers) {
  require(width > 0 && height > 0 && layers >= 0, "texture", "its size must be over 0");
  GLint most = 0, most_layers = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_layers);
  if (std::max(width, height) > most || layers > most_layers) {
    throw Error("OpenGL", fmt::format("a texture of {}×{}, {} layers is more than the driver's {}, {}", width,
                                      height, layers, most, most_layers));
  }
  if (mipmaps) levels_ = std::bit_width(static_cast<unsigned>(std::max(width, height)));
  unsigned id = 0;
  glCreateTextures(layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &id);
  handle_ = Handle<delete_texture>(id);
  const FormatInfo info = info_of(format);
  if (layers > 0) {
    glTextureStorage3D(id, levels_, info.internal, width, height, layers);
  } else {
    glTextureStorage2D(id, levels_, info.internal, width, height);
  }
  set_filter(false);
}

std::size_t Texture::bytes() const {
  return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
         static_cast<std::size_t>(std::max(layers_, 1)) * bytes_per_texel(format_);
}

void Texture::upload(std::span<const std::byte> data, int layer) {
  upload_rect(data, 0, 0, width_, height_, layer);
}

void Texture::upload_rect(std::span<const std::byte> data, int x, int y, int width, int height, int layer) {
  const FormatInfo info = info_of(format_);
  require(x >= 0 && y >= 0 && width >= 0 && height >= 0 && x <= width_ - width && y <= height_ - height &&
              layer >= 0 && layer < std::max(layers_, 1),
          "texture", "the rectangle does not lie inside");
  require(data.size() == info.bytes * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "texture", "there are not the bytes of the rectangle");
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (layers_ > 0) {
    glTextureSubImage3D(id(), 0, x, y, layer, width, height, 1, info.external, info.type, data.data());
  } else {
    glTextureSubImage2D(id(), 0, x, y, width, height, info.external, info.type, data.data());
  }
}

void Texture::generate_mipmaps() {
  glGenerateTextureMipmap(id());
}

void Texture::set_filter(bool linear) {
  const GLint filter = linear ? GL_LINEAR : GL_NEAREST;
  glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, linear && levels_ > 1 ? GL_LINEAR_MIPMAP_LINEAR : filter);
  glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, filter);
  glTextureParameteri(id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void Texture::read(std::span<float> out, int channels) const {
  constexpr GLenum externals[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  require(channels >= 1 && channels <= 4, "texture", "a texel has 1 to 4 channels");
  require(out.size() >= static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                            static_cast<std::size_t>(std::max(layers_, 1)) *
                            static_cast<std::size_t>(format_ == Format::depth32f ? 1 : channels),
          "texture", "there is no room for its texels");
  const GLenum external =
      format_ == Format::depth32f ? GL_DEPTH_COMPONENT : externals[static_cast<std::size_t>(channels) - 1];
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(id(), 0, external, GL_FLOAT, static_cast<GLsizei>(out.size_bytes()), out.data());
}

void Texture::bind(unsigned unit) const {
  glBindTextureUnit(unit, id());
}

void Texture::bind_image(unsigned unit) const {
  glBindImageTexture(unit, id(), 0, layers_ > 0, 0, GL_READ_WRITE, info_of(format_).internal);
}

Size size_of_texture(unsigned id, const std::string& what) {
  GLint target = 0;
  Size size;
  if (glIsTexture(id)) glGetTextureParameteriv(id, GL_TEXTURE_TARGET, &target);
  if (target != GL_TEXTURE_2D) throw Error(what, fmt::format("OpenGL has no 2-D texture of number {}", id));
  glGetTextureLevelParameteriv(id, 0, GL_TEXTURE_WIDTH, &size.width);
  glGetTextureLevelParameteriv(id, 0, GL_TEXTURE_HEIGHT, &size.height);
  if (size.width < 1 || size.height < 1) throw Error(what, fmt::format("texture {} has no texels", id));
  return size;
}

void bind_texture(unsigned unit, unsigned id) {
  glBindTextureUnit(unit, id);
}

Sampler::Sampler(Address u, Address v, bool nearest, float anisotropy) {
  unsigned id = 0;
  glCreateSamplers(1, &id);
  handle_ = Handle<delete_sampler>(id);
  glSamplerParameteri(id, GL_TEXTURE_WRAP_S, static_cast<GLint>(wrap_of(u)));
  glSamplerParameteri(id, GL_TEXTURE_WRAP_T, static_cast<GLint>(wrap_of(v)));
  glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, nearest ? GL_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
  // Core since 4.6 only, but every driver has the extension
  if (!nearest && anisotropy > 1 && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
    glSamplerParameterf(id, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
}

void Sampler::bind(unsigned unit) const {
  glBindSampler(unit, handle_.get());
}

void Sampler::unbind(unsigned unit) {
  glBindSampler(unit, 0);
}

}  // namespace ssphh::gl
