#include "live_light.h"

#include <ssphh/scene/query.h>

namespace ssphh::viewer {
namespace {

std::vector<gi::ProbePlace> find_places(const scene::Scene& scene, const scene::TransportSource& source,
                                        const LiveLightParams& params, float time, const Control& control) {
  if (!params.places.empty()) return params.places;
  gi::PlaceParams place = gi::place_params(scene, time);
  place.spacing = params.spacing;
  std::vector<gi::ProbePlace> places;
  for (const gi::PlacedProbe& probe : gi::place_probes(source, place, control).probes)
    places.push_back({probe.name, probe.position, probe.radius});
  return places;
}

gi::Probe dark_probe(const gi::ProbePlace& place) {
  gi::Probe probe;
  probe.name = place.name;
  probe.position = place.position;
  probe.radius = place.radius;
  return probe;
}

}  // namespace

LiveLight::LiveLight(std::shared_ptr<const scene::Scene> scene, const LiveLightParams& params, float time,
                     const Control& control)
    : scene_(std::move(scene)),
      source_(params.geometry ? params.geometry : trace::geometry_of(scene_), *scene_) {
  std::vector<gi::ProbePlace> places = find_places(*scene_, source_, params, time, control);
  session_ = std::make_unique<gi::RelightSession>(source_, std::move(places), params.relight, time, control);
  session_->update();  // The first one lights everything; the window should not wait for it.
}

gi::RelightReport LiveLight::update(const std::vector<scene::LightState>& lights,
                                    const std::vector<vec3>& scales, float time) {
  session_->set_time(time);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const int light = static_cast<int>(i);
    if (session_->light(light) != lights[i]) session_->set_light(light, lights[i]);
  }
  for (std::size_t g = 0; g < scales.size(); ++g) session_->set_group_scale(static_cast<int>(g), scales[g]);
  return session_->update();
}

gi::ProbeSet LiveLight::probes() const {
  gi::ProbeSet set;
  set.generator.op = gi::LightOperator::surfel;
  set.light_groups.push_back({"all"});
  const std::vector<gi::ProbePlace>& places = session_->places();
  const std::vector<sh::RadianceSh>& reflected = session_->reflected();
  for (std::size_t i = 0; i < places.size(); ++i) {
    gi::Probe probe = dark_probe(places[i]);
    probe.groups.push_back({{}, reflected[i]});
    set.probes.push_back(std::move(probe));
  }
  set.degree = reflected.front().degree();
  gi::merge_groups(set);
  return set;
}

void LiveLight::refresh(gi::ProbeSet& set) const {
  const std::vector<sh::RadianceSh>& reflected = session_->reflected();
  for (std::size_t i = 0; i < reflected.size(); ++i) {
    gi::Probe& probe = set.probes[i];
    probe.groups[0].reflected = reflected[i];
    probe.reflected = reflected[i];
    probe.self = reflected[i];
  }
}

gi::ProbeSet LiveLight::bake(const scene::Scene& scene, const std::vector<vec3>& scales, float time,
                             const Control& control) const {
  const auto reflected = session_->reflected_by_group(control);
  const auto emitted = session_->emitted_by_group();
  const gi::TransportParams& transport = session_->network().params();
  gi::ProbeSet set;
  set.degree = session_->reflected().front().degree();
  set.generator.op = gi::LightOperator::surfel;
  set.generator.directions = transport.directions;
  set.generator.surfel_size = transport.surfel_size;
  set.generator.link_rays = transport.link_rays;
  set.generator.scene = scene.name;
  set.generator.scene_hash = scene::light_hash(scene);
  set.generator.time = time;
  const std::vector<std::string>& groups = source_.light_groups();
  for (std::size_t g = 0; g < groups.size(); ++g) set.light_groups.push_back({groups[g], scales[g]});
  for (std::size_t i = 0; i < session_->places().size(); ++i) {
    gi::Probe probe = dark_probe(session_->places()[i]);
    for (std::size_t g = 0; g < groups.size(); ++g) probe.groups.push_back({emitted[g][i], reflected[g][i]});
    set.probes.push_back(std::move(probe));
  }
  gi::merge_groups(set);
  return set;
}

}  // namespace ssphh::viewer
