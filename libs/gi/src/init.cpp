#include <ssphh/gi/init.h>

#include "probe_limits.h"

namespace ssphh::gi {

ProbeSet init_from_scene(const scene::Scene& scene, int degree, float time) {
  if (degree < 0 || degree > sh::max_degree) {
    throw Error("degree " + std::to_string(degree),
                "the degree must be 0.." + std::to_string(sh::max_degree));
  }
  const std::string where = "scene " + (scene.name.empty() ? std::string("without a name") : scene.name);
  const std::vector<scene::SphlPlace> places = scene::sphl_places(scene, time);
  if (places.empty()) {
    throw Error(where, "has no enabled SPHL, so there is nothing to bake",
                "name a node \"SPHL...\" or give it extras {\"sphl\": {\"radius\": 0.1}}; the built-in "
                "galleries have some");
  }
  if (places.size() > limits::probes) {
    throw Error(where, "has " + std::to_string(places.size()) + " SPHLs; at most " +
                           std::to_string(limits::probes) + " are supported");
  }
  ProbeSet set;
  set.degree = degree;
  set.generator.scene = scene.name.substr(0, limits::text);
  set.generator.scene_hash = scene::scene_hash(scene);
  set.generator.time = time;
  for (const scene::SphlPlace& place : places) {
    if (!is_finite(place.position) || !std::isfinite(place.radius) || place.radius <= 0) {
      throw Error("SPHL \"" + place.name + "\"", "its position must be finite and its radius positive");
    }
    Probe probe;
    probe.name = place.name.substr(0, limits::text);
    probe.position = place.position;
    probe.radius = place.radius;
    set.probes.push_back(std::move(probe));
  }
  return set;
}

}  // namespace ssphh::gi
