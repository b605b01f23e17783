#include <ssphh/rays/radiance_source.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::rays {

bool TransportSource::joined(int part, const RayQuery& segment) const {
  RayHit hit;
  intersect(part, {&segment, 1}, {&hit, 1});
  return hit.escaped() && hit.through == vec3(1);
}

std::unique_ptr<RadianceSource> TransportSource::path_tracing(const scene::LightingState&) const {
  throw Error("transport source", "it cannot trace paths");
}

scene::LightingState lighting_at(const TransportSource& source, float time) {
  scene::LightingState state;
  state.time = time;
  state.lights = source.lights(time);
  state.group_scales.assign(source.light_groups().size(), vec3(1));
  return state;
}

}  // namespace ssphh::rays
