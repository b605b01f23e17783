#include <ssphh/place/init.h>
#include <ssphh/probes/probe_limits.h>

namespace ssphh::place {

namespace {

probes::ProbeSet set_of(const scene::Scene& scene, std::span<const scene::ProbePlace> places, int degree,
                        float time) {
  probes::ProbeSet set = probes::dark_set(places, degree);
  set.generator.scene = scene.name.substr(0, probes::limits::text);
  set.generator.scene_hash = scene::light_hash(scene);
  set.generator.time = time;
  return set;
}

}  // namespace

probes::ProbeSet init_from_scene(const scene::Scene& scene, int degree, float time) {
  const std::string where = "scene " + (scene.name.empty() ? std::string("without a name") : scene.name);
  const std::vector<scene::ProbePlace> places = scene::sphl_places(scene, time);
  if (places.empty()) {
    throw Error(where, "has no enabled SPHL, so there is nothing to bake",
                "let --probes auto find places, or name a node \"SPHL...\" or give it extras {\"sphl\": "
                "{\"radius\": 0.1}}");
  }
  if (places.size() > probes::limits::probes) {
    throw Error(where, "has " + std::to_string(places.size()) + " SPHLs; at most " +
                           std::to_string(probes::limits::probes) + " are supported");
  }
  return set_of(scene, places, degree, time);
}

probes::ProbeSet init_from_placement(const scene::Scene& scene, const Placement& placement, int degree,
                                     float time) {
  return set_of(scene, scene::places_of(placement.probes), degree, time);
}

}  // namespace ssphh::place
