/// The pass of a method's light: straight into the picture, or by images as the probes' pass.

#include "renderer_data.h"

namespace ssphh::realtime {

void Renderer::Data::draw_method(const FrameSettings& settings) {
  if (images.indirect_scale > 1 || settings.ambient_occlusion) {
    gl::bind_framebuffer(images.indirect_pass.id(), images.indirect());
    gl::clear_color(0, 0, 0, 0, 0);
    gl::clear_color(1, 0, 0, 0, 0);
    gl::Program& program = shaders.method(method->kind(), scene.any_full(), true);
    for (int pass = 0; pass < method->passes(); ++pass) {
      method->bind(program, pass);
      fullscreen(program, images.indirect_pass.id(), images.indirect(), {.blend = gl::Blend::add});
    }
    return apply_images(settings);
  }
  for_each_class([&](bool full, const gl::DrawState& where) {
    gl::Program& program = shaders.method(method->kind(), full, false);
    for (int pass = 0; pass < method->passes(); ++pass) {
      method->bind(program, pass);
      fullscreen(program, images.light_pass.id(), images.full(), where);
    }
  });
}

}  // namespace ssphh::realtime
