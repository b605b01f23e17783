#include <array>

#include <fmt/format.h>

#include <ssphh/core/stopwatch.h>
#include <ssphh/gl/saved_state.h>

#include "renderer_data.h"

namespace ssphh::realtime {
namespace {

struct Part {
  const char* name;
  unsigned texture;
};
std::array<Part, 6> parts_of(const GBuffer& g) {
  return {{{"depth", g.position == 0 ? g.depth : 0},
           {"position", g.position},
           {"normal", g.normal},
           {"geometric normal", g.geometric_normal},
           {"albedo", g.albedo},
           {"moving", g.moving}}};
}

gl::Size size_of(const GBuffer& gbuffer) {
  if (gbuffer.normal == 0 || (gbuffer.depth == 0 && gbuffer.position == 0))
    throw Error("G-buffer", "it needs a texture of normals, and one of depth or of positions");
  std::optional<gl::Size> size;
  for (const auto& [name, texture] : parts_of(gbuffer)) {
    if (texture == 0) continue;
    const gl::Size own = gl::size_of_texture(texture, fmt::format("G-buffer, {}", name));
    if (!size) size = own;
    if (own != *size)
      throw Error(fmt::format("G-buffer, {}", name),
                  fmt::format("its texture has {} x {} texels, others have {} x {}", own.width, own.height,
                              size->width, size->height));
  }
  return *size;
}

Eye engines_eye(const GBuffer& g) {
  const float near = g.empty_depth < 0.5f ? 1.0f : g.zero_to_one ? 0.0f : -1.0f;
  return eye_of(g.view_projection, near, g.empty_depth < 0.5f ? (g.zero_to_one ? 0.0f : -1.0f) : 1.0f);
}

}  // namespace

void Renderer::Data::take_geometry() {
  const GBuffer& g = *taken;
  unsigned end = unit::taken;
  for (const Part& part : parts_of(g)) {
    if (part.texture != 0) gl::bind_texture(end, part.texture);
    texel_sampler.bind(end++);
  }
  gl::Program& program = shaders.take_gbuffer();
  program.set("given", g.position != 0, g.geometric_normal != 0, g.albedo != 0, g.moving != 0);
  program.set("stored", g.zero_to_one, g.normal_from_zero);
  program.set("empty_depth", g.empty_depth);
  program.set("clip_to_world", mat4(glm::inverse(glm::dmat4(g.view_projection))));
  gl::bind_framebuffer(images.geometry_pass.id(), images.full());
  gl::clear_stencil(surface_class::nothing);
  gl::clear_color_uint(0, 0, 0, 0, 0);
  gl::clear_color_uint(1, 0, 0, 0, 0);
  gl::clear_color(2, 0, 0, 0, 0);
  fullscreen(program, images.geometry_pass.id(), images.full(), {.stencil_write = surface_class::lambertian});
  for (unsigned i = unit::taken; i < end; ++i) gl::Sampler::unbind(i);
  images.gbuffer0.bind(unit::gbuffer0);
  images.gbuffer1.bind(unit::gbuffer1);
}

const gl::Texture& Renderer::draw_indirect(const GBuffer& gbuffer, const FrameSettings& settings) {
  const gl::Size size = size_of(gbuffer);
  const Eye eye = engines_eye(gbuffer);
  Data& d = *data_;
  d.context.forget_errors();
  const gl::SavedState host;
  const Stopwatch watch;
  FrameSettings own = settings;
  own.view = View::indirect;
  own.direct = own.wireframe = false;
  own.indirect = true;
  own.supersample = 1;
  d.in_pieces = false;
  d.taken = gbuffer;
  d.make_room(own, {.width = size.width, .height = size.height});
  d.choose_direct(own);
  d.plan(eye);
  d.stats.cpu_ms = watch.milliseconds();
  while (step()) {
  }
  return d.images.color;
}

}  // namespace ssphh::realtime
