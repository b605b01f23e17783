#pragma once

#include <cstddef>
#include <span>

#include <ssphh/gl/handle.h>

namespace ssphh::gl {

/// Memory of the renderer. Its size is fixed; `reserve` replaces it by a larger one.
class Buffer {
 public:
  Buffer() = default;
  /// Throws Error when there is no memory for it.
  explicit Buffer(std::size_t bytes);
  template <class T>
  explicit Buffer(std::span<const T> data) : Buffer(data.size_bytes()) {
    update(data);
  }

  std::size_t size() const { return bytes_; }
  unsigned id() const { return handle_.get(); }
  /// Makes room for `bytes`; contents are lost when that takes a new allocation.
  void reserve(std::size_t bytes);
  void update_bytes(std::size_t offset, std::span<const std::byte> data);
  template <class T>
  void update(std::span<const T> data, std::size_t first = 0) {
    update_bytes(first * sizeof(T), std::as_bytes(data));
  }
  void bind_storage(unsigned binding) const;
  void bind_uniform(unsigned binding) const;
  /// `offset` must be a multiple of 256.
  void bind_uniform_range(unsigned binding, std::size_t offset, std::size_t bytes) const;

 private:
  Handle<delete_buffer> handle_;
  std::size_t bytes_ = 0;
};

}  // namespace ssphh::gl
