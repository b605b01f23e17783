#include <epoxy/gl.h>

#include <ssphh/gl/vertex_array.h>

namespace ssphh::gl {

void delete_vertex_array(unsigned id) {
  glDeleteVertexArrays(1, &id);
}

VertexArray::VertexArray() {
  unsigned id = 0;
  glCreateVertexArrays(1, &id);
  handle_ = Handle<delete_vertex_array>(id);
}

void VertexArray::attribute(unsigned location, const Buffer& buffer, int components, std::size_t stride,
                            std::size_t offset) {
  const unsigned id = handle_.get();
  glEnableVertexArrayAttrib(id, location);
  glVertexArrayAttribFormat(id, location, components, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(id, location, location);
  glVertexArrayVertexBuffer(id, location, buffer.id(), 0, static_cast<GLsizei>(stride));
}

void VertexArray::indices(const Buffer& buffer) {
  glVertexArrayElementBuffer(handle_.get(), buffer.id());
}

void VertexArray::bind() const {
  glBindVertexArray(handle_.get());
}

}  // namespace ssphh::gl
