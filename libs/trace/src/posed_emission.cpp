/// Photons of the groups of posed lights.

#include "posed_light.h"
#include "surface_gap.h"

namespace ssphh::trace {

float PosedLight::flux(int group) const {
  float sum = 0;
  for (const GroupEmitter& light : emitters_of(group))
    sum += lights_.flux(light.index, geometry_.bounds().radius());
  return sum;
}

std::optional<rays::Photon> PosedLight::emit(int group, const rays::PhotonNumbers& numbers) const {
  // Choose an emitter by its flux; what is left of the number is not needed.
  const float all = flux(group);
  if (!(all > 0)) return std::nullopt;
  const GroupEmitter* chosen = nullptr;
  float below = 0, probability = 0;
  for (const GroupEmitter& light : emitters_of(group)) {
    const float share = lights_.flux(light.index, geometry_.bounds().radius()) / all;
    if (!(share > 0)) continue;
    chosen = &light, probability = share;
    below += share;
    if (numbers.emitter < below) break;
  }
  auto emitted = lights_.emit(chosen->index, numbers.place, numbers.direction, geometry_.bounds().center(),
                              1.001f * geometry_.bounds().radius());
  if (!emitted) return std::nullopt;
  rays::Photon& photon = emitted->photon;
  photon.power /= probability;
  if (emitted->normal != vec3(0)) photon.origin = above_surface(photon.origin, emitted->normal, data_->gap);
  return photon;
}

std::vector<vec3> PosedLight::emitter_places(int group, float widest, int count) const {
  const auto flux_of = [&](const GroupEmitter& light) {
    const scene::Bounds& box = light.emitter.extent;
    const bool counts =
        !light.emitter.distant() && !light.emitter.delta() && max_component(box.max - box.min) <= widest;
    return counts ? lights_.flux(light.index, geometry_.bounds().radius()) : 0;
  };
  float all = 0;
  for (const GroupEmitter& light : emitters_of(group)) all += flux_of(light);
  std::vector<vec3> places;
  for (const GroupEmitter& light : emitters_of(group)) {
    const float flux = flux_of(light);
    if (!(flux > 0)) continue;
    const int here = static_cast<int>(static_cast<float>(count) * (flux / all)) + 1;
    for (int i = 0; i < here; ++i) {
      SampleSequence random(0, static_cast<std::uint32_t>(i));
      const vec2 u_place = random.next2(), u_direction = random.next2();
      const auto emitted = lights_.emit(light.index, u_place, u_direction, vec3(0), 0);
      if (emitted) places.push_back(emitted->photon.origin);
    }
  }
  return places;
}

}  // namespace ssphh::trace
