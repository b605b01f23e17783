#include <algorithm>

#include <epoxy/gl.h>

#include <ssphh/gl/read_pixels.h>

namespace ssphh::gl {

std::vector<std::uint8_t> read_pixels(unsigned framebuffer, const Rect& part) {
  const auto row = 4 * static_cast<std::size_t>(part.width);
  const auto rows = static_cast<std::size_t>(part.height);
  std::vector<std::uint8_t> pixels(row * rows);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(part.x, part.y, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  // OpenGL's first row is the lowest one.
  for (std::size_t y = 0; y < rows / 2; ++y) {
    const auto lower = pixels.begin() + static_cast<std::ptrdiff_t>(y * row);
    std::swap_ranges(lower, lower + static_cast<std::ptrdiff_t>(row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - y) * row));
  }
  for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = 255;
  return pixels;
}

}  // namespace ssphh::gl
