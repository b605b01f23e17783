#include <epoxy/gl.h>
#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/gl/vertex_array.h>

namespace ssphh::gl {
namespace {

struct Layout {
  GLenum type;
  std::size_t bytes;  ///< of one number, or of all that are packed together
  bool packed = false;
};
Layout layout(Component component) {
  switch (component) {
    case Component::f32:
      return {GL_FLOAT, 4};
    case Component::f16:
      return {GL_HALF_FLOAT, 2};
    case Component::snorm8:
      return {GL_BYTE, 1};
    case Component::unorm8:
      return {GL_UNSIGNED_BYTE, 1};
    case Component::snorm16:
      return {GL_SHORT, 2};
    case Component::unorm16:
      return {GL_UNSIGNED_SHORT, 2};
    case Component::snorm10:
      return {GL_INT_2_10_10_10_REV, 4, true};
  }
  throw Error("vertices", fmt::format("there is no component {}", static_cast<int>(component)));
}

/// `bytes` from `offset` on lie in the buffer, at multiples of `alignment`.
void check_range(unsigned buffer, std::size_t offset, std::size_t bytes, std::size_t alignment,
                 const std::string& what) {
  if (buffer == 0 || glIsBuffer(buffer) != GL_TRUE)
    throw Error(what, fmt::format("OpenGL has no buffer of number {}", buffer));
  if (offset % alignment != 0)
    throw Error(what, fmt::format("they begin at byte {}, which is no multiple of {}", offset, alignment));
  GLint64 size = 0;
  glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size);
  const auto there = static_cast<std::size_t>(size);
  if (offset > there || bytes > there - offset)
    throw Error(what, fmt::format("{} bytes from byte {} on are needed; buffer {} has {}", bytes, offset,
                                  buffer, there));
}

}  // namespace

void delete_vertex_array(unsigned id) {
  glDeleteVertexArrays(1, &id);
}

void check_source(const VertexSource& source, int components, std::size_t vertices, const std::string& what) {
  const Layout numbers = layout(source.type);
  const std::size_t one = numbers.bytes * (numbers.packed ? 1 : static_cast<std::size_t>(components));
  GLint most = 0;
  glGetIntegerv(GL_MAX_VERTEX_ATTRIB_STRIDE, &most);
  if (source.stride > static_cast<std::size_t>(most) || source.stride % numbers.bytes != 0)
    throw Error(what, fmt::format("the stride is {} bytes; it must be a multiple of {}, and {} at most",
                                  source.stride, numbers.bytes, most));
  check_range(source.buffer, source.offset, vertices > 0 ? (vertices - 1) * source.stride + one : 0,
              numbers.bytes, what);
}

void check_source(const IndexSource& source, std::size_t corners, const std::string& what) {
  check_range(source.buffer, source.offset, corners * size_of(source.type), size_of(source.type), what);
}

VertexArray::VertexArray() {
  unsigned id = 0;
  glCreateVertexArrays(1, &id);
  handle_ = Handle<delete_vertex_array>(id);
}

void VertexArray::attribute(unsigned location, const VertexSource& source, int components) {
  const unsigned id = handle_.get();
  const Layout numbers = layout(source.type);
  const bool floats = numbers.type == GL_FLOAT || numbers.type == GL_HALF_FLOAT;
  glEnableVertexArrayAttrib(id, location);
  glVertexArrayAttribFormat(id, location, numbers.packed ? 4 : components, numbers.type,
                            floats ? GL_FALSE : GL_TRUE, 0);
  glVertexArrayAttribBinding(id, location, location);
  glVertexArrayVertexBuffer(id, location, source.buffer, static_cast<GLintptr>(source.offset),
                            static_cast<GLsizei>(source.stride));
}

void VertexArray::indices(unsigned buffer) {
  glVertexArrayElementBuffer(handle_.get(), buffer);
}

void VertexArray::bind() const {
  glBindVertexArray(handle_.get());
}

}  // namespace ssphh::gl
