#pragma once

#include <cstddef>

#include <ssphh/gl/buffer.h>

namespace ssphh::gl {

/// How vertex shaders read buffers.
class VertexArray {
 public:
  /// Without attributes: for passes that make their vertices from gl_VertexID.
  VertexArray();

  /// Floats at `offset` within elements of `stride` bytes.
  void attribute(unsigned location, const Buffer& buffer, int components, std::size_t stride,
                 std::size_t offset);
  /// 32-bit indices.
  void indices(const Buffer& buffer);
  void bind() const;

 private:
  Handle<delete_vertex_array> handle_;
};

}  // namespace ssphh::gl
