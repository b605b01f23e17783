#pragma once
/// How the irradiance of a sky is sampled, for light that is needed now and for light that is kept.

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "posed_light.h"

namespace ssphh::trace {

template <class Add>
void PosedLight::sample_sky(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, int count,
                            RayTask& task, const Add& add) const {
  // A constant sky by cosine alone, which is exact where nothing hides it; an image half by cosine, half by
  // its own brightness, combined with the balance heuristic.
  const bool constant = data_->scene.environment->equirect.empty();
  const int by_cosine = constant ? count : (count + 1) / 2;
  const float share = static_cast<float>(by_cosine) / static_cast<float>(count);
  const Frame frame = Frame::around(at.normal);
  for (int s = 0; s < count; ++s) {
    const bool cosine_sample = s < by_cosine;
    SampleSequence sequence(cosine_sample ? seed : mix64(seed),
                            static_cast<std::uint32_t>(cosine_sample ? s : s - by_cosine));
    const vec2 u = sequence.next2();
    std::optional<shading::LightSample> sample;
    if (!cosine_sample) {
      sample = lights_.sample_emitter(light.index, at.position, u);
      if (!sample) continue;
    }
    const vec3 wi = sample ? sample->wi : frame.to_world(sample_cosine_hemisphere(u));
    const float cosine = glm::dot(wi, at.normal);
    if (!(cosine > 0)) continue;
    const vec3 through = geometry_.transmittance({at.start, wi}, 0, task);
    if (!(max_component(through) > 0)) continue;
    // Looking up the image costs more than the ray.
    vec3 radiance;
    float sky_pdf;
    if (sample) {
      radiance = sample->radiance, sky_pdf = sample->pdf;
    } else {
      const auto sky = lights_.distant_radiance(light.index, wi);
      radiance = sky->radiance, sky_pdf = sky->pdf;
    }
    add(wi, through * radiance * (cosine / (share * cosine / pi + (1 - share) * sky_pdf)));
  }
}

}  // namespace ssphh::trace
