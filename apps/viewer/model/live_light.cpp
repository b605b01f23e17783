#include "live_light.h"

#include <algorithm>

#include <ssphh/scene/light_mode.h>
#include <ssphh/scene/query.h>

namespace ssphh::viewer {
namespace {

std::vector<scene::ProbePlace> find_places(const scene::Scene& scene, const rays::TransportSource& source,
                                           const LiveLightParams& params, float time,
                                           const Control& control) {
  if (!params.places.empty()) return params.places;
  place::PlaceParams place = place::place_params(scene, time);
  place.spacing = params.spacing;
  return scene::places_of(place::place_probes(source, place, control).probes);
}

}  // namespace

LiveLight::LiveLight(std::shared_ptr<const scene::Scene> scene, const LiveLightParams& params, float time,
                     const Control& control)
    : scene_(std::move(scene)),
      glance_(params.glance),
      source_(params.geometry ? params.geometry : trace::geometry_of(scene_), *scene_) {
  std::vector<scene::ProbePlace> places = find_places(*scene_, source_, params, time, control);
  transport::RelightParams relight = params.relight;
  const std::vector<scene::LightMode> modes = scene::light_modes(*scene_);
  for (std::size_t g = 0; g < modes.size() && relight.records.points > 0; ++g)
    if (modes[g] == scene::LightMode::diffuse) relight.records.baked.push_back(static_cast<int>(g));
  session_.emplace(source_, std::move(places), relight, time, control);
  // The first one lights everything; the window should not wait for it
  session_->update(rays::lighting_at(source_, time), control);
}

probes::ProbeSet LiveLight::probes() const {
  probes::ProbeSet set = transport::lookup_set(*session_);
  set.generator.op = probes::LightOperator::surfel;
  return set;
}

void LiveLight::refresh(probes::ProbeSet& set) const {
  transport::refresh(set, *session_);
}

probes::ProbeSet LiveLight::bake(const scene::Scene& scene, const Control& control) const {
  probes::GeneratorInfo generator;
  generator.op = probes::LightOperator::surfel;
  generator.scene = scene.name;
  generator.scene_hash = scene::light_hash(scene);
  return transport::baked_set(*session_, source_.light_groups(), generator, control);
}

LiveLightParams at_a_glance(LiveLightParams params) {
  transport::TransportParams& transport = params.relight.transport;
  transport.most_surfels = std::min(transport.most_surfels, 6000);
  transport.link_rays = std::min(transport.link_rays, 48);
  transport.directions = std::min(transport.directions, 384);
  transport.samples = std::min(transport.samples, 4);
  params.relight.records.points = 0;
  params.glance = true;
  return params;
}

std::shared_ptr<LiveLight> find_light(std::shared_ptr<const scene::Scene> scene, LiveLightParams params,
                                      float time, const Control& control,
                                      const std::function<void(std::shared_ptr<LiveLight>)>& glance) {
  if (glance) {
    const auto coarse = std::make_shared<LiveLight>(scene, at_a_glance(params), time, control);
    params.places = coarse->session().places();
    glance(coarse);
  }
  return std::make_shared<LiveLight>(std::move(scene), params, time, control);
}

}  // namespace ssphh::viewer
