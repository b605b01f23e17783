#include <ssphh/place/init.h>
#include <ssphh/probes/probe_limits.h>

namespace ssphh::place {

namespace {

probes::ProbeSet empty_set(const scene::Scene& scene, int degree, float time) {
  if (degree < 0 || degree > sh::max_degree) {
    throw Error("degree " + std::to_string(degree),
                "the degree must be 0.." + std::to_string(sh::max_degree));
  }
  probes::ProbeSet set;
  set.degree = degree;
  set.generator.scene = scene.name.substr(0, probes::limits::text);
  set.generator.scene_hash = scene::light_hash(scene);
  set.generator.time = time;
  return set;
}

void add_probe(probes::ProbeSet& set, const std::string& name, const vec3& position, float radius) {
  if (!is_finite(position) || !std::isfinite(radius) || radius <= 0) {
    throw Error("SPHL \"" + name + "\"", "its position must be finite and its radius positive");
  }
  probes::Probe probe;
  probe.name = name.substr(0, probes::limits::text);
  probe.position = position;
  probe.radius = radius;
  set.probes.push_back(std::move(probe));
}

}  // namespace

probes::ProbeSet init_from_scene(const scene::Scene& scene, int degree, float time) {
  probes::ProbeSet set = empty_set(scene, degree, time);
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
  for (const scene::ProbePlace& place : places) add_probe(set, place.name, place.position, place.radius);
  return set;
}

probes::ProbeSet init_from_placement(const scene::Scene& scene, const Placement& placement, int degree,
                                     float time) {
  probes::ProbeSet set = empty_set(scene, degree, time);
  for (const PlacedProbe& probe : placement.probes) add_probe(set, probe.name, probe.position, probe.radius);
  return set;
}

}  // namespace ssphh::place
