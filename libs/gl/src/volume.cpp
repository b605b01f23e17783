#include <epoxy/gl.h>
#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/gl/volume.h>

namespace ssphh::gl {
namespace {

std::size_t volume_of(const ivec3& size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
         static_cast<std::size_t>(size.z);
}

}  // namespace

Volume::Volume(const ivec3& size) : size_(size) {
  require(size.x > 0 && size.y > 0 && size.z > 0, "volume texture", "its size must be over 0");
  GLint most = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
  if (size.x > most || size.y > most || size.z > most)
    throw Error("OpenGL", fmt::format("a volume of {}×{}×{} texels is more than the driver's {}", size.x,
                                      size.y, size.z, most));
  unsigned id = 0;
  glCreateTextures(GL_TEXTURE_3D, 1, &id);
  handle_ = Handle<delete_texture>(id);
  glTextureStorage3D(id, 1, GL_RGBA16F, size.x, size.y, size.z);
  GLint width = 0;  // 0 where there was no memory
  glGetTextureLevelParameteriv(id, 0, GL_TEXTURE_WIDTH, &width);
  if (width != size.x) throw Error("OpenGL", fmt::format("no memory for a volume of {} MiB", bytes() >> 20));
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(id, axis, GL_CLAMP_TO_EDGE);
  clear();
}

std::size_t Volume::bytes() const {
  return volume_of(size_) * texel_bytes;
}

void Volume::clear() {
  glClearTexImage(id(), 0, GL_RGBA, GL_HALF_FLOAT, nullptr);
}

void Volume::upload_box(std::span<const std::uint64_t> texels, const ivec3& corner, const ivec3& size) {
  require(glm::all(glm::greaterThanEqual(glm::min(corner, size), ivec3(0))) &&
              glm::all(glm::lessThanEqual(corner, size_ - size)),
          "volume texture", "the box does not lie inside");
  require(texels.size() == volume_of(size), "volume texture", "there are not the texels of the box");
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  glTextureSubImage3D(id(), 0, corner.x, corner.y, corner.z, size.x, size.y, size.z, GL_RGBA, GL_HALF_FLOAT,
                      texels.data());
}

void Volume::bind(unsigned unit) const {
  glBindTextureUnit(unit, id());
}

}  // namespace ssphh::gl
