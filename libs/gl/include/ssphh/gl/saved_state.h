#pragma once

#include <memory>

namespace ssphh::gl {

/// OpenGL's state as a host has set it, put back at the end: all that passes of this library change. Beside
/// objects of its own these are: program; framebuffers; viewports and scissors; tests, masks, functions and
/// operations of depth, stencil, blending, culling and colours, for each colour attachment; polygon mode,
/// clip control, front face, sRGB, seamless cube maps and the switches of apply_conventions(); vertex array;
/// the first 16 texture units with their samplers, image unit 0, the first 8 bindings of uniform and storage
/// buffers, the buffer of indirect dispatch; alignment of rows of pixels. The host must not be within a query
/// of GL_TIME_ELAPSED, conditional rendering or transform feedback.
class SavedState {
 public:
  SavedState();
  ~SavedState();
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace ssphh::gl
