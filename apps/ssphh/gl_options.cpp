#include "gl_options.h"

#include <ssphh/core/log.h>
#include <ssphh/gi/probe_file.h>
#include <ssphh/scene/query.h>

#include "probe_options.h"

namespace ssphh::app {

void set_probes(realtime::Renderer& renderer, const GlLookup& options, const scene::Scene& scene,
                float time) {
  if (options.probes.empty()) return;
  const gi::ProbeSet set = gi::read_probe_file(options.probes);
  require_same_scene(options.probes, set, scene, scene::light_groups(scene), time, options.force);
  if (set.fitted && options.lookup == "irradiance" && options.weights.empty()) {
    log_warning("{}: has fitted weights, which are for --backend cpu: drawn with mls", options.probes);
  }
  gi::LookupParams params;
  if (options.light == "self") params.layer = gi::ProbeLayer::self;
  renderer.set_probes(set, params);
}

realtime::FrameSettings still_settings(const GlLookup& options, int samples) {
  realtime::FrameSettings settings;
  settings.lookup = options.lookup == "light" ? gi::LookupMethod::light : gi::LookupMethod::irradiance;
  if (options.weights == "distance") settings.weights = gi::WeightMethod::distance;
  settings.supersample = samples;
  return settings;
}

}  // namespace ssphh::app
