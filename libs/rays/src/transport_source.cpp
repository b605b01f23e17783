#include <ssphh/core/require.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::rays {

namespace {

void only_still_part(int part) {
  require(part == 0, "transport source", "it has no such part");
}

}  // namespace

const std::string& TransportSource::part_name(int part) const {
  only_still_part(part);
  static const std::string name = "still";
  return name;
}

mat4 TransportSource::part_pose(int part, float) const {
  only_still_part(part);
  return mat4(1);
}

std::vector<PartPoint> TransportSource::sample_part(int, double) const {
  return {};
}

void TransportSource::occluded(int part, std::span<const RayQuery> rays,
                               std::span<std::uint8_t> blocked) const {
  std::vector<RayHit> hits(rays.size());
  intersect(part, rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = !hits[i].escaped();
}

std::vector<scene::LightState> TransportSource::lights(float) const {
  return {};
}

const std::vector<std::string>& TransportSource::light_names() const {
  static const std::vector<std::string> none;
  return none;
}

int TransportSource::light_group_of(int) const {
  refuse("transport source", "it has no lamps");
}

bool TransportSource::group_emits_from(int, int part) const {
  return part == 0;
}

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
