#pragma once
/// Points as lamps see them in panes.

#include <algorithm>
#include <cmath>

#include "pane_mirrors.h"
#include "posed_light.h"

namespace ssphh::trace {

template <class Add>
void PosedLight::for_images(int group, const Receiver& at, const Add& add) const {
  const std::vector<GroupEmitter>& emitters = emitters_of(group);
  // Lamps without extent light nothing by way of mirrors, as no path can be told to go there.
  if (std::ranges::all_of(emitters, [](const GroupEmitter& light) { return light.emitter.delta(); })) return;
  for (std::size_t p = 0; p < data_->panes.size(); ++p) {
    const std::optional<Receiver> image = mirrored_receiver(at, p);
    if (!image) continue;
    for (std::size_t k = 0; k < emitters.size(); ++k) {
      const GroupEmitter& light = emitters[k];
      if (light.emitter.delta()) continue;
      if (light.emitter.kind == shading::EmitterKind::environment || may_arrive(light, *image))
        add(light, *image, hash_combine(image->seed, k));
    }
  }
}

template <class Add>
void PosedLight::sample_mirrored_sky(const GroupEmitter& light, const Receiver& image, std::uint64_t seed,
                                     int count, RayTask& task, const Add& add) const {
  // As many samples as the pane's share of the hemisphere is worth, twice; a share of one by chance. Far
  // panes are told from that without their exact share.
  const Pane& pane = *image.pane;
  const vec3 position = pane.mirrored(image.position), normal = pane.mirrored_direction(image.normal);
  const float u = SampleSequence(seed, 0).next();
  const auto samples_of = [&](float share) { return 2 * share * static_cast<float>(count); };
  const float between = glm::distance(pane.bounds.center(), position) - pane.bounds.radius();
  if (between > 0 && samples_of(pane.area / (pi * between * between)) + u < 1) return;
  shading::MeshView view(position, normal, vec3(1), light.emitter.group);
  for (const Pane::Triangle& t : pane.triangles) view.add(t.corner, t.corner + t.edge1, t.corner + t.edge2);
  const float expected = samples_of(view.irradiance().x / pi);
  const int taken = static_cast<int>(expected + u);
  for (int s = 0; s < taken; ++s) {
    auto toward = view.sample(SampleSequence(mix64(seed), static_cast<std::uint32_t>(s)).next2());
    if (!toward || !(toward->pdf > 0)) continue;
    toward->distance = std::numeric_limits<float>::infinity();
    const vec3 share = mirrored_share(geometry_, pane, image.start, position, *toward, 0, task);
    if (!(max_component(share) > 0)) continue;
    const auto sky = lights_.distant_radiance(light.index, pane.mirrored_direction(toward->wi));
    if (sky) add(toward->wi, share * sky->radiance / (toward->pdf * expected));
  }
}

}  // namespace ssphh::trace
