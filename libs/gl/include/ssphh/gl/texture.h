#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <ssphh/gl/handle.h>

namespace ssphh::gl {

enum class Format {
  rgba8,
  srgb8_alpha8,
  r16f,
  rgba16f,
  r32f,
  rg32f,
  rgba32f,
  rg32ui,
  rgba32ui,
  depth32f,
  depth32f_stencil8
};

std::size_t bytes_per_texel(Format format);

/// 2-D image or array of them, with optional mipmaps.
class Texture {
 public:
  Texture() = default;
  /// `layers` > 0 makes an array. Throws Error for sizes that the driver does not offer.
  Texture(Format format, int width, int height, int layers = 0, bool mipmaps = false);

  unsigned id() const { return handle_.get(); }
  int width() const { return width_; }
  int height() const { return height_; }
  int layers() const { return layers_; }
  Format format() const { return format_; }
  std::size_t bytes() const;

  /// Binds level 0 as an image that shaders read and write texel by texel.
  void bind_image(unsigned unit) const;

  /// Whole level 0 of one layer, rows as in memory: row 0 first. 8-bit formats take bytes, others floats.
  void upload(std::span<const std::byte> data, int layer = 0);
  /// A rectangle of level 0.
  void upload_rect(std::span<const std::byte> data, int x, int y, int width, int height, int layer = 0);
  void generate_mipmaps();
  /// Linear or nearest filtering, clamped at the edges, for textures bound without a Sampler.
  void set_filter(bool linear);
  /// Floats of level 0, rows as stored; `channels` per texel.
  void read(std::span<float> out, int channels) const;
  void bind(unsigned unit) const;

 private:
  Handle<delete_texture> handle_;
  Format format_ = Format::rgba8;
  int width_ = 0, height_ = 0, layers_ = 0, levels_ = 1;
};

struct Size {
  int width = 0, height = 0;
  friend bool operator==(const Size&, const Size&) = default;
};
/// The size of level 0 of a 2-D texture that somebody else made, by OpenGL's number. Throws Error that begins
/// with `what` where there is none.
Size size_of_texture(unsigned id, const std::string& what);
/// By OpenGL's number.
void bind_texture(unsigned unit, unsigned id);

enum class Address { repeat, mirror, clamp };

/// How a texture is read: wrapping and filtering, apart from its texels.
class Sampler {
 public:
  Sampler() = default;
  /// Trilinear with up to `anisotropy` samples, or nearest texel.
  Sampler(Address u, Address v, bool nearest, float anisotropy = 1);
  void bind(unsigned unit) const;
  /// The texture's own settings hold again.
  static void unbind(unsigned unit);

 private:
  Handle<delete_sampler> handle_;
};

}  // namespace ssphh::gl
