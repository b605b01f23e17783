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

}  // namespace

LiveLight::LiveLight(std::shared_ptr<const scene::Scene> scene, const LiveLightParams& params, float time,
                     const Control& control)
    : scene_(std::move(scene)),
      source_(params.geometry ? params.geometry : trace::geometry_of(scene_), *scene_) {
  std::vector<gi::ProbePlace> places = find_places(*scene_, source_, params, time, control);
  session_.emplace(source_, std::move(places), params.relight, time, control);
  // The first one lights everything; the window should not wait for it
  session_->update(scene::lighting_at(source_, time), control);
}

gi::ProbeSet LiveLight::probes() const {
  gi::ProbeSet set = gi::lookup_set(session_->places(), session_->reflected());
  set.generator.op = gi::LightOperator::surfel;
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

gi::ProbeSet LiveLight::bake(const scene::Scene& scene, const Control& control) const {
  gi::GeneratorInfo generator;
  generator.op = gi::LightOperator::surfel;
  generator.scene = scene.name;
  generator.scene_hash = scene::light_hash(scene);
  return gi::baked_set(*session_, source_.light_groups(), generator, control);
}

}  // namespace ssphh::viewer
