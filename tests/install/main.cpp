// Renders a built-in scene through the installed libraries: the modules must be found, compile and link.

#include <cstdio>

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
  // Closed box whose walls emit 1, seen directly.
  std::printf("%.2f\n",
              static_cast<double>(ssphh::trace::resolve(state.color, state.passes_done).rgb(16, 9).x));
  return 0;
}
