#include "frame_images.h"

#include <array>

namespace ssphh::realtime {

using gl::Format;
using gl::Framebuffer;
using gl::Texture;

FrameImages::FrameImages(int w, int h, int samples, int scale)
    : width(w), height(h), supersample(samples), indirect_scale(scale) {
  const gl::Rect f = full(), i = indirect();
  gbuffer0 = Texture(Format::rgba32ui, f.width, f.height);
  gbuffer1 = Texture(Format::r32ui, f.width, f.height);
  emitted = Texture(Format::rgba16f, f.width, f.height);
  depth = Texture(Format::depth32f, f.width, f.height);
  direct = Texture(Format::rgba16f, f.width, f.height);
  irradiance = Texture(Format::rgba16f, i.width, i.height);
  glossy = Texture(Format::rgba16f, i.width, i.height);
  color = Texture(Format::rgba32f, f.width, f.height);
  resolved = Texture(Format::rgba32f, width, height);
  occlusion = Texture(Format::r16f, f.width, f.height);
  geometry_pass = Framebuffer(std::array<const Texture*, 3>{&gbuffer0, &gbuffer1, &emitted}, &depth);
  direct_pass = Framebuffer(std::array<const Texture*, 1>{&direct}, nullptr);
  indirect_pass = Framebuffer(std::array<const Texture*, 2>{&irradiance, &glossy}, nullptr);
  compose_pass = Framebuffer(std::array<const Texture*, 1>{&color}, nullptr);
  resolve_pass = Framebuffer(std::array<const Texture*, 1>{&resolved}, nullptr);
  occlusion_pass = Framebuffer(std::array<const Texture*, 1>{&occlusion}, nullptr);
}

gl::Rect FrameImages::indirect() const {
  const gl::Rect f = full();
  return {0, 0, (f.width + indirect_scale - 1) / indirect_scale,
          (f.height + indirect_scale - 1) / indirect_scale};
}

std::size_t FrameImages::bytes() const {
  std::size_t sum = 0;
  for (const Texture* t :
       {&gbuffer0, &gbuffer1, &emitted, &depth, &direct, &irradiance, &glossy, &color, &resolved, &occlusion})
    sum += t->bytes();
  return sum;
}

}  // namespace ssphh::realtime
