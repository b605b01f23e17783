#include <epoxy/gl.h>
#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/gl/buffer.h>

namespace ssphh::gl {

void delete_buffer(unsigned id) {
  glDeleteBuffers(1, &id);
}

Buffer::Buffer(std::size_t bytes) : bytes_(bytes) {
  unsigned id = 0;
  glCreateBuffers(1, &id);
  handle_ = Handle<delete_buffer>(id);
  // Empty buffers cannot be bound
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes > 0 ? bytes : 16), nullptr, GL_DYNAMIC_STORAGE_BIT);
  GLint64 size = 0;
  glGetNamedBufferParameteri64v(id, GL_BUFFER_SIZE, &size);
  if (size < static_cast<GLint64>(bytes))
    throw Error("OpenGL", fmt::format("no memory for a buffer of {} MiB", bytes >> 20));
}

void Buffer::reserve(std::size_t bytes) {
  if (handle_.get() == 0 || bytes > bytes_) *this = Buffer(bytes);
}

void Buffer::update_bytes(std::size_t offset, std::span<const std::byte> data) {
  require(offset <= bytes_ && data.size() <= bytes_ - offset, "buffer", "there is no room for so many bytes");
  if (data.empty()) return;
  glNamedBufferSubData(handle_.get(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()),
                       data.data());
}

void Buffer::bind_storage(unsigned binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, handle_.get());
}

void Buffer::bind_uniform(unsigned binding) const {
  glBindBufferBase(GL_UNIFORM_BUFFER, binding, handle_.get());
}

void Buffer::bind_uniform_range(unsigned binding, std::size_t offset, std::size_t bytes) const {
  glBindBufferRange(GL_UNIFORM_BUFFER, binding, handle_.get(), static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes));
}

}  // namespace ssphh::gl
