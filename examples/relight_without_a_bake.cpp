// Bakes the probes of a built-in scene once, then switches lamps off: no new bake, light groups add up.

#include <cstdio>

#include <ssphh/bake/bake.h>
#include <ssphh/core/log.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>

using namespace ssphh;

int main() {
  // A closed box whose walls emit 1 and reflect half: 1 arrives directly, ½ after one scattering, ¼ after
  // two.
  const scene::Scene scene = scene::make_builtin("box");
  const trace::PathTracer tracer(scene);

  bake::BakeParams params;
  params.face_size = 16;
  params.path = {.max_depth = 2, .passes = 1, .spp = 64, .seed = 1};
  params.viz = false;
  bake::BakeReport report;
  probes::ProbeSet probes = bake::bake(tracer, place::init_from_scene(scene, 2), params, "", report);

  const auto print = [&](const char* state) {
    const auto light = probes::make_lookup(probes::LookupMethod::irradiance, probes, tracer);
    const vec3 e = light->irradiance({probes.probes[0].position, {0, 1, 0}});
    std::printf("%-9s indirect irradiance %.1f W/m2\n", state, static_cast<double>(e.x));
  };
  print("lamps on");  // π (½ + ¼) = 2.36
  for (const probes::LightGroup& group : probes::ProbeSet(probes).light_groups)
    probes::relight(probes, group.name, vec3(0.5f));
  print("dimmed");
  for (const probes::LightGroup& group : probes::ProbeSet(probes).light_groups)
    probes::relight(probes, group.name, vec3(0));
  print("lamps off");
}
