#include "shaders.h"

namespace ssphh::realtime {

Shaders::Shaders(const gl::ShaderFiles& files)
    : geometry(files, "gbuffer.vert", "gbuffer.frag"),
      shadow(files, "shadow.vert", "shadow.frag"),
      shadow_alpha(files, "shadow.vert", "shadow.frag", "#define ALPHA"),
      direct(files, "fullscreen.vert", "direct.frag"),
      indirect(files, "fullscreen.vert", "indirect.frag"),
      occlusion(files, "fullscreen.vert", "occlusion.frag"),
      compose(files, "fullscreen.vert", "compose.frag"),
      resolve(files, "fullscreen.vert", "resolve.frag"),
      display(files, "fullscreen.vert", "display.frag") {}

std::string Shaders::warnings() const {
  std::string all;
  for (const gl::Program* p :
       {&geometry, &shadow, &shadow_alpha, &direct, &indirect, &occlusion, &compose, &resolve, &display})
    all += p->warnings();
  return all;
}

}  // namespace ssphh::realtime
