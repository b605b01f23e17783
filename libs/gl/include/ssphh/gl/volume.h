#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <ssphh/core/math.h>
#include <ssphh/gl/handle.h>

namespace ssphh::gl {

using glm::ivec3;

/// 3-D image of four halves (fp16) a texel, filtered linearly, clamped at its edges.
class Volume {
 public:
  static constexpr std::size_t texel_bytes = 8;

  Volume() = default;
  /// Texels are 0. Throws Error for a size that the driver does not offer or has no memory for.
  explicit Volume(const ivec3& size);

  unsigned id() const { return handle_.get(); }
  const ivec3& size() const { return size_; }
  std::size_t bytes() const;

  /// Every texel 0.
  void clear();
  /// A box of texels as glm::packHalf4x16 packs them, in the order of x, y, z.
  void upload_box(std::span<const std::uint64_t> texels, const ivec3& corner, const ivec3& size);
  void bind(unsigned unit) const;

 private:
  Handle<delete_texture> handle_;
  ivec3 size_{0};
};

}  // namespace ssphh::gl
