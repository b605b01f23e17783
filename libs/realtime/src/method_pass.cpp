/// The pass of a method's light: as the probes' pass.

#include "renderer_data.h"

namespace ssphh::realtime {

void Renderer::Data::draw_method() {
  if (frame_settings.ambient_occlusion) draw_occlusion();
  if (images.indirect_scale > 1) {
    gl::bind_framebuffer(images.indirect_pass.id(), images.indirect());
    gl::clear_color(0, 0, 0, 0, 0);
    gl::clear_color(1, 0, 0, 0, 0);
    gl::Program& some = shaders.method(method->kind(), scene.any_full(), IndirectOutput::images);
    for (int pass = 0; pass < method->passes(); ++pass) {
      method->bind(some, pass);
      fullscreen(some, images.indirect_pass.id(), images.indirect(), {.blend = gl::Blend::add});
    }
    interpolate_indirect();
    gl::Program& others = shaders.method(method->kind(), scene.any_full(), IndirectOutput::listed);
    for (int pass = 0; pass < method->passes(); ++pass) {
      method->bind(others, pass);
      draw_listed(others);
    }
    return;
  }
  for_each_class([&](bool full, const gl::DrawState& where) {
    gl::Program& program = shaders.method(method->kind(), full, IndirectOutput::radiance);
    for (int pass = 0; pass < method->passes(); ++pass) {
      method->bind(program, pass);
      fullscreen(program, images.light_pass.id(), images.full(), where);
    }
  });
}

}  // namespace ssphh::realtime
