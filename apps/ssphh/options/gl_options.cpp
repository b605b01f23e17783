#include "options/gl_options.h"

#include <ssphh/scene/query.h>
#include <ssphh/trace/path_tracer.h>

#include "options/probe_options.h"

namespace ssphh::app {

namespace {

/// `geometry` may be null: built where it is asked.
void hand_over(realtime::Renderer& renderer, const std::string& name, const probes::ProbeSet& set,
               const probes::LookupSpec& spec, const trace::SharedGeometry& geometry,
               const scene::Scene& scene, float time) {
  const probes::LookupParams params = lookup_params(name, set, spec);
  renderer.set_probes(set, params);
  if (spec.method != probes::LookupMethod::irradiance) return;
  const probes::WeightMethod chosen = probes::chosen_weights(set, params);
  if (chosen != probes::WeightMethod::surface && chosen != probes::WeightMethod::fitted) return;
  const trace::PathTracer tracer(geometry ? geometry : std::make_shared<const trace::SceneGeometry>(scene),
                                 scene, time);
  const auto sees = [&](const vec3& a, const vec3& b) { return tracer.visible(a, b); };
  if (chosen == probes::WeightMethod::fitted)
    return renderer.set_fitted(probes::prepare_fitted(scene, time, *set.fitted, sees));
  const auto joined = [&](const vec3& a, const vec3& b) { return tracer.joined(a, b); };
  renderer.set_records(probes::prepare_surfaces(scene, time, set.surface->points, joined));
  renderer.set_record_light(set.surface->light);
}

}  // namespace

void set_probes(realtime::Renderer& renderer, const GlLookup& options, const scene::Scene& scene,
                float time) {
  if (options.probes.empty()) return;
  const probes::ProbeSet set = read_probes_of(scene, options.probes, time, options.force);
  hand_over(renderer, options.probes, set, options.spec, nullptr, scene, time);
}

void set_method(realtime::Renderer& renderer, const methods::LightData& light, const probes::LookupSpec& spec,
                const trace::SharedGeometry& geometry, const scene::Scene& scene, float time) {
  if (const auto* probes = std::get_if<methods::ProbeLight>(&light))
    return hand_over(renderer, "method ssphh", *probes->set, spec, geometry, scene, time);
  renderer.set_method_light(light);
}

realtime::FrameSettings still_settings(const GlLookup& options, int samples) {
  realtime::FrameSettings settings;
  settings.lookup = options.spec.method;
  settings.weights = options.spec.weights.value_or(probes::WeightMethod::surface);
  settings.supersample = samples;
  return settings;
}

}  // namespace ssphh::app
