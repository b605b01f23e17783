#pragma once
/// How the irradiance of a sky is sampled, for light that is needed now and for light that is kept.

#include <vector>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "edge_cells.h"
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

template <class Add>
void PosedLight::sample_kept_sky(const GroupEmitter& light, const Receiver& at, std::uint64_t seed, int count,
                                 RayTask& task, const Add& add) const {
  // An image with a sun, so many times as bright as its mean, is sampled by that as well
  constexpr float hot_pdf = 32 / (4 * pi);
  constexpr std::uint32_t draws = 64;
  for (std::uint32_t s = 0; s < draws; ++s) {
    const auto drawn = lights_.sample_emitter(light.index, at.position, SampleSequence(0, s).next2());
    if (!drawn || !(drawn->pdf > hot_pdf)) continue;
    sample_sky(light, at, seed, count, task, [&](const vec3& wi, const vec3& irradiance) {
      add(wi, irradiance / static_cast<float>(count));
    });
    return;
  }
  constexpr std::uint32_t more_at_edges = 16;
  const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<float>(count))));
  const Frame frame = Frame::around(at.normal);
  EdgeCells cells(side);
  struct Look {
    int cell;
    vec3 wi, through;
  };
  std::vector<Look> looks;
  const auto look_at = [&](int cell, std::uint32_t times) {
    const vec2 corner(static_cast<float>(cell % side), static_cast<float>(cell / side));
    for (std::uint32_t k = 0; k < times; ++k) {
      SampleSequence sequence(hash_combine(seed, static_cast<std::uint64_t>(cell)), cells.looks(cell));
      const vec2 u = (corner + sequence.next2()) / static_cast<float>(side);
      const vec3 wi = frame.to_world(sample_cosine_hemisphere(u));
      const vec3 through = geometry_.transmittance({at.start, wi}, 0, task);
      const bool sees = max_component(through) > 0;
      cells.add(cell, sees);
      if (sees) looks.push_back({cell, wi, through});
    }
  };
  for (int cell = 0; cell < cells.count(); ++cell) look_at(cell, 1);
  for (int cell = 0; cell < cells.count(); ++cell)
    if (cells.at_edge(cell)) look_at(cell, more_at_edges);
  std::vector<int> beside;
  for (int cell = 0; cell < cells.count(); ++cell)
    if (cells.looks(cell) == 1 && cells.beside_divided(cell)) beside.push_back(cell);
  for (const int cell : beside) look_at(cell, more_at_edges);
  for (const Look& l : looks) {
    const auto sky = lights_.distant_radiance(light.index, l.wi);
    const float share = pi / (static_cast<float>(cells.count()) * static_cast<float>(cells.looks(l.cell)));
    add(l.wi, share * l.through * sky->radiance);
  }
}

}  // namespace ssphh::trace
