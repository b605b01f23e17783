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
  gbuffer1 = Texture(Format::rg32ui, f.width, f.height);
  depth = Texture(Format::depth32f_stencil8, f.width, f.height);
  color = Texture(Format::rgba32f, f.width, f.height);
  irradiance = Texture(Format::rgba16f, i.width, i.height);
  glossy = Texture(Format::rgba16f, i.width, i.height);
  occlusion = Texture(Format::r16f, f.width, f.height);
  shadow = Texture(Format::rgba16f, f.width, f.height);
  if (samples > 1) resolved = Texture(Format::rgba32f, width, height);
  using Colors1 = std::array<const Texture*, 1>;
  geometry_pass = Framebuffer(std::array<const Texture*, 3>{&gbuffer0, &gbuffer1, &color}, &depth);
  light_pass = Framebuffer(Colors1{&color}, &depth);
  indirect_pass = Framebuffer(std::array<const Texture*, 2>{&irradiance, &glossy}, nullptr);
  occlusion_pass = Framebuffer(Colors1{&occlusion}, &depth);
  shadow_pass = Framebuffer(Colors1{&shadow}, &depth);
  if (samples > 1) resolve_pass = Framebuffer(Colors1{&resolved}, nullptr);
}

gl::Rect FrameImages::indirect() const {
  const gl::Rect f = full();
  return {0, 0, (f.width + indirect_scale - 1) / indirect_scale,
          (f.height + indirect_scale - 1) / indirect_scale};
}

std::size_t FrameImages::bytes() const {
  std::size_t sum = 0;
  for (const Texture* t :
       {&gbuffer0, &gbuffer1, &depth, &color, &irradiance, &glossy, &occlusion, &shadow, &resolved}) {
    if (t->id() != 0) sum += t->bytes();
  }
  return sum;
}

}  // namespace ssphh::realtime
