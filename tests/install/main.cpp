// Renders a built-in scene through the installed libraries: the modules must be found, compile and link, and
// shaders must be there without the source tree.

#include <cstdio>

#include <ssphh/farm/engine.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>

int main() {
  const ssphh::scene::Scene scene = ssphh::scene::make_builtin("box");
  const ssphh::trace::PathTracer tracer(scene);
  ssphh::trace::RenderParams params;
  params.width = 32, params.height = 18;
  params.camera = ssphh::scene::camera_pose(scene, "");
  params.path.max_depth = 0;
  ssphh::trace::RenderState state;
  tracer.render(params, state);
  try {
    ssphh::gl::Context context = ssphh::gl::Context::headless();
    ssphh::realtime::Renderer renderer(context, scene);
    renderer.draw(params.camera, {}, {.width = 32, .height = 18});
    if (!(renderer.read_back().rgb(16, 9).x > 0)) return 1;
  } catch (const ssphh::Error& e) {
    std::fprintf(stderr, "no picture by OpenGL: %s\n", e.what());
  }
  if (ssphh::farm::engine_id().empty()) return 1;
  // Closed box whose walls emit 1, seen directly.
  std::printf("%.2f\n",
              static_cast<double>(ssphh::trace::resolve(state.color, state.passes_done).rgb(16, 9).x));
  return 0;
}
