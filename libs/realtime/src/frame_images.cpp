#include "frame_images.h"

#include <array>

#include "gpu_types.h"

namespace ssphh::realtime {

using gl::Format;
using gl::Framebuffer;
using gl::Texture;

FrameImages::FrameImages(int w, int h, int samples, int scale)
    : width(w), height(h), supersample(samples), indirect_scale(scale) {
  const gl::Rect f = full();
  gbuffer0 = Texture(Format::rgba32ui, f.width, f.height);
  gbuffer1 = Texture(Format::rg32ui, f.width, f.height);
  depth = Texture(Format::depth32f_stencil8, f.width, f.height);
  color = Texture(Format::rgba32f, f.width, f.height);
  occlusion = Texture(Format::r16f, f.width, f.height);
  shadow = Texture(Format::rgba16f, f.width, f.height);
  if (samples > 1) resolved = Texture(Format::rgba32f, width, height);
  using Colors1 = std::array<const Texture*, 1>;
  geometry_pass = Framebuffer(std::array<const Texture*, 3>{&gbuffer0, &gbuffer1, &color}, &depth);
  light_pass = Framebuffer(Colors1{&color}, &depth);
  glass_pass = Framebuffer(std::array<const Texture*, 3>{nullptr, nullptr, &color}, nullptr);
  occlusion_pass = Framebuffer(Colors1{&occlusion}, &depth);
  shadow_pass = Framebuffer(Colors1{&shadow}, &depth);
  if (samples > 1) resolve_pass = Framebuffer(Colors1{&resolved}, nullptr);
  if (scale > 1) make_interpolation();
}

void FrameImages::make_interpolation() {
  const gl::Rect f = full(), i = indirect();
  irradiance = Texture(Format::rgba16f, i.width, i.height);
  glossy = Texture(Format::rgba16f, i.width, i.height);
  irradiance.set_filter(true);
  glossy.set_filter(true);
  cells = Texture(Format::rgba32ui, i.width, i.height);
  listed = gl::Buffer(sizeof(ListHead) + sizeof(unsigned) * static_cast<std::size_t>(f.width) *
                                             static_cast<std::size_t>(f.height));
  indirect_pass = Framebuffer(std::array<const Texture*, 2>{&irradiance, &glossy}, nullptr);
  cells_pass = Framebuffer(std::array<const Texture*, 1>{&cells}, nullptr);
}

void FrameImages::want_bodies() {
  if (exits.id() != 0) return;
  const gl::Rect f = full();
  exits = Texture(Format::rgba32ui, f.width, f.height);
  exit_depth = Texture(Format::depth32f, f.width, f.height);
  behind_glass = Texture(Format::rgba32f, f.width, f.height);
  exits_pass = Framebuffer(std::array<const Texture*, 1>{&exits}, &exit_depth);
  bent_pass = Framebuffer(std::array<const Texture*, 3>{nullptr, nullptr, &color}, &depth);
}

void FrameImages::want_frost() {
  if (behind_frost.id() != 0) return;
  const gl::Rect f = full();
  behind_frost = Texture(Format::rgba32f, f.width, f.height, 0, true);
  behind_gbuffer1 = Texture(Format::rg32ui, f.width, f.height);
  left_by_glass = Texture(Format::rgba32f, f.width, f.height);
  left_by_glass_pass = Framebuffer(std::array<const Texture*, 3>{nullptr, nullptr, &left_by_glass}, nullptr);
}

gl::Rect FrameImages::indirect() const {
  const gl::Rect f = full();
  return {0, 0, (f.width + indirect_scale - 1) / indirect_scale,
          (f.height + indirect_scale - 1) / indirect_scale};
}

std::size_t FrameImages::bytes() const {
  std::size_t sum = listed.size();
  for (const Texture* t :
       {&gbuffer0, &gbuffer1, &depth, &color, &irradiance, &glossy, &cells, &occlusion, &shadow, &resolved,
        &exits, &exit_depth, &behind_glass, &behind_frost, &behind_gbuffer1, &left_by_glass}) {
    if (t->id() != 0) sum += t->bytes();
  }
  return sum;
}

}  // namespace ssphh::realtime
