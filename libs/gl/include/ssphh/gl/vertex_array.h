#pragma once

#include <cstddef>
#include <string>

#include <ssphh/gl/draw.h>

namespace ssphh::gl {

/// How a number of a vertex is stored: floats; integers that stand for −1..1 (snorm) or 0..1 (unorm);
/// snorm10 is GL_INT_2_10_10_10_REV, up to four numbers in 32 bits.
enum class Component { f32, f16, snorm8, unorm8, snorm16, unorm16, snorm10 };

/// Where vertices have an attribute: in any buffer of OpenGL, this library's or its host's.
struct VertexSource {
  unsigned buffer = 0;     ///< OpenGL's number
  std::size_t offset = 0;  ///< of the first vertex's, in bytes
  std::size_t stride = 0;  ///< from one vertex to the next, in bytes; 0: all have the same
  Component type = Component::f32;
};
/// Where the corners of triangles are named.
struct IndexSource {
  unsigned buffer = 0;     ///< OpenGL's number
  std::size_t offset = 0;  ///< of the first corner's, in bytes
  Index type = Index::u32;
};

/// Whether the buffer holds attributes of `components` numbers for so many vertices, or so many corners.
/// Throws Error with `what` for the number of no buffer, one that is too small, a stride that no driver
/// takes, and what is not aligned to the size of its numbers.
void check_source(const VertexSource& source, int components, std::size_t vertices, const std::string& what);
void check_source(const IndexSource& source, std::size_t corners, const std::string& what);

/// How vertex shaders read buffers, which must live as long.
class VertexArray {
 public:
  /// Without attributes: for passes that make their vertices from gl_VertexID.
  VertexArray();

  void attribute(unsigned location, const VertexSource& source, int components);
  void indices(unsigned buffer);
  void bind() const;

 private:
  Handle<delete_vertex_array> handle_;
};

}  // namespace ssphh::gl
