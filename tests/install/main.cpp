// Bakes a built-in scene through the installed libraries: every module must be found, compile and link.

#include <cstdio>

#include <ssphh/core/log.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>

int main() {
  const ssphh::scene::Scene scene = ssphh::scene::make_builtin("box");
  const ssphh::trace::PathTracer tracer(scene);
  ssphh::trace::RenderParams params;
  params.width = 32, params.height = 18;
  params.camera = ssphh::scene::camera_pose(scene, "");
  params.path.max_depth = 2;
  ssphh::trace::RenderState state;
  tracer.render(params, state);
  // Closed box, Le = 1, albedo 1/2: depth 2 gives 1 + 1/2 + 1/4.
  std::printf("%.2f\n",
              static_cast<double>(ssphh::trace::resolve(state.color, state.passes_done).rgb(16, 9).x));
  return 0;
}
