#pragma once

#include <utility>

namespace ssphh::gl {

/// Owner of one OpenGL name; 0 owns nothing.
template <void (*Delete)(unsigned)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(unsigned id) : id_(id) {}
  ~Handle() {
    if (id_ != 0) Delete(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  unsigned get() const { return id_; }

 private:
  unsigned id_ = 0;
};

void delete_buffer(unsigned id);
void delete_texture(unsigned id);
void delete_sampler(unsigned id);
void delete_framebuffer(unsigned id);
void delete_vertex_array(unsigned id);
void delete_program(unsigned id);
void delete_query(unsigned id);

}  // namespace ssphh::gl
