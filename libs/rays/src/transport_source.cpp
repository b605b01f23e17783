#include <ssphh/rays/radiance_source.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::rays {

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
