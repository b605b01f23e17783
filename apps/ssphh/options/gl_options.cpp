#include "options/gl_options.h"

#include <ssphh/scene/query.h>
#include <ssphh/trace/path_tracer.h>

#include "options/probe_options.h"

namespace ssphh::app {

void set_probes(realtime::Renderer& renderer, const GlLookup& options, const scene::Scene& scene,
                float time) {
  if (options.probes.empty()) return;
  const probes::ProbeSet set = read_probes_of(scene, options.probes, time, options.force);
  const probes::LookupParams params = lookup_params(options.probes, set, options.spec);
  renderer.set_probes(set, params);
  if (options.spec.method != probes::LookupMethod::irradiance) return;
  const probes::WeightMethod chosen = probes::chosen_weights(set, params);
  if (chosen != probes::WeightMethod::surface && chosen != probes::WeightMethod::fitted) return;
  const trace::PathTracer tracer(scene, time);
  const auto sees = [&](const vec3& a, const vec3& b) { return tracer.visible(a, b); };
  if (chosen == probes::WeightMethod::fitted)
    return renderer.set_fitted(probes::prepare_fitted(scene, time, *set.fitted, sees));
  const auto joined = [&](const vec3& a, const vec3& b) { return tracer.joined(a, b); };
  renderer.set_records(probes::prepare_surfaces(scene, time, set.surface->points, joined));
  renderer.set_record_light(set.surface->light);
}

realtime::FrameSettings still_settings(const GlLookup& options, int samples) {
  realtime::FrameSettings settings;
  settings.lookup = options.spec.method;
  settings.weights = options.spec.weights.value_or(probes::WeightMethod::surface);
  settings.supersample = samples;
  return settings;
}

}  // namespace ssphh::app
