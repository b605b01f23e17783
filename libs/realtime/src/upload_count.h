#pragma once

#include <cstdint>

#include <ssphh/gl/buffer.h>

namespace ssphh::realtime {

/// What a frame sent to OpenGL, counted where it is sent.
struct FrameCounters {
  std::uint64_t draw_calls = 0, triangles = 0, bytes_uploaded = 0;
};

template <class T>
void upload(FrameCounters& counters, gl::Buffer& buffer, std::span<const T> data) {
  buffer.update(data);
  counters.bytes_uploaded += data.size_bytes();
}

}  // namespace ssphh::realtime
