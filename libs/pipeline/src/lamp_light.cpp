#include <algorithm>
#include <optional>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/require.h>
#include <ssphh/pipeline/lamp_light.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/transport/session_sets.h>

namespace ssphh::pipeline {
namespace {

transport::RelightParams session_params(const probes::ProbeSet& set) {
  const bake::TransportBakeParams baked = bake::transport_params_of(set);
  transport::RelightParams params{baked.transport, baked.solve};
  params.degree = std::min(set.degree, probes::max_irradiance_degree);
  return params;
}

}  // namespace

struct LampLight::Data {
  const rays::RadianceSource& sight;
  transport::RelightSession session;
  scene::LightingState dark;  ///< the scene's lights, every group off
  std::vector<int> group_of;  ///< of each light
  probes::ProbeSet set;
  std::optional<probes::IrradianceLookup> lookup;
};

LampLight::LampLight(const rays::TransportSource& source, const rays::RadianceSource& sight,
                     const probes::ProbeSet& set, const Control& control)
    : data_(std::make_unique<Data>(
          Data{sight,
               {source, scene::places_of(set.probes), session_params(set), set.generator.time, control},
               rays::lighting_at(source, set.generator.time),
               {},
               {},
               {}})) {
  Data& d = *data_;
  for (std::size_t i = 0; i < d.dark.lights.size(); ++i)
    d.group_of.push_back(source.light_group_of(static_cast<int>(i)));
  d.session.update(d.dark, control);
  if (set.surface && !set.surface->points.empty())
    d.session.keep_records_at(set.surface->points, {.rays = transport::GatherParams{}.rays}, control);
  d.dark.group_scales.assign(d.dark.group_scales.size(), vec3(0));
}
LampLight::~LampLight() = default;
LampLight::LampLight(LampLight&&) noexcept = default;
LampLight& LampLight::operator=(LampLight&&) noexcept = default;

const rays::IndirectLight& LampLight::at(std::size_t light, const vec3& place, const Control& control) {
  Data& d = *data_;
  require(light < d.dark.lights.size(), "light of a lamp", "there is no light of that index");
  require(is_finite(place), "light of a lamp", "its place must be finite");
  scene::LightingState state = d.dark;
  const int group = d.group_of[light];
  state.group_scales[static_cast<std::size_t>(group)] = vec3(1);
  for (std::size_t i = 0; i < state.lights.size(); ++i)
    if (i != light && d.group_of[i] == group) state.lights[i].intensity = 0;
  state.lights[light].world[3] = vec4(place, 1);
  d.session.update(state, control);
  if (d.lookup) {
    transport::refresh(d.set, d.session);
    d.lookup->swap_light(d.set);
  } else {
    d.set = transport::lookup_set(d.session);
    d.lookup.emplace(d.set, d.sight);
  }
  return *d.lookup;
}

}  // namespace ssphh::pipeline
