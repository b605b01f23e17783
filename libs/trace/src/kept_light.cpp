/// Direct light that is kept: sampled often enough that no noise is seen, and with how it turns.

#include <ssphh/core/require.h>

#include "mirror_images.h"
#include "posed_light.h"
#include "sample_sky.h"
#include "surface_gap.h"

namespace ssphh::trace {
namespace {

/// Irradiance by directions, and how it changes as the surface turns.
class SumByNormal {
 public:
  explicit SumByNormal(const vec3& normal) : frame_(Frame::around(normal)) {}

  void add(const vec3& direction, const vec3& irradiance) {
    // What grazes counts as at this cosine: a few such samples would rule the derivative's noise.
    constexpr float least_cosine = 0.1f;
    const vec3 local = frame_.to_local(direction);
    const vec2 slope = vec2(local) / std::max(local.z, least_cosine);
    level_ += irradiance;
    x_ += slope.x * irradiance;
    y_ += slope.y * irradiance;
  }

  const vec3& level() const { return level_; }

  void add_to(rays::IrradianceByNormal& light, const vec3& factor) const {
    for (glm::length_t c = 0; c < 3; ++c) light[c] += factor * (frame_.x[c] * x_ + frame_.y[c] * y_);
    light[3] += factor * level_;
  }

 private:
  Frame frame_;
  vec3 level_{0}, x_{0}, y_{0};
};

vec2 sample_place(std::uint64_t seed, int s) {
  return SampleSequence(seed, static_cast<std::uint32_t>(s)).next2();
}

}  // namespace

void PosedLight::add_by_normal(const GroupEmitter& emitter, const Receiver& at, std::uint64_t seed,
                               int samples, RayTask& task, rays::IrradianceByNormal& light) const {
  const int count = emitter.emitter.delta() ? 1 : samples;
  SumByNormal sum(at.normal);
  vec3 factor(1 / static_cast<float>(count));
  if (emitter.emitter.kind == shading::EmitterKind::environment) {
    sample_kept_sky(emitter, at, seed, count, task,
                    [&](const vec3& wi, const vec3& irradiance) { sum.add(wi, irradiance); });
    sum.add_to(light, vec3(1));
    return;
  }
  const auto view = lights_.view_mesh(emitter.index, at.position, at.normal);
  vec3 open(0), brightest(0);
  for (int s = 0; s < count; ++s) {
    const vec2 u = sample_place(seed, s);
    const auto sample = view ? view->sample(u) : lights_.sample_emitter(emitter.index, at.position, u);
    if (!sample || !(sample->pdf > 0)) continue;
    const float cosine = glm::dot(sample->wi, at.normal);
    if (!(cosine > 0) || !(max_component(sample->radiance) > 0)) continue;
    brightest = glm::max(brightest, sample->radiance);
    const vec3 irradiance = sample->radiance * (cosine / sample->pdf);
    open += irradiance;
    sum.add(sample->wi, irradiance * arriving_share(at, *sample, task));
  }
  if (view) {
    // A ratio of sums, as irradiance() has it: no noise where all or nothing is hidden.
    for (glm::length_t c = 0; c < 3; ++c) factor[c] = open[c] > 0 ? view->irradiance()[c] / open[c] : 0;
  } else if (emitter.emitter.kind == shading::EmitterKind::mesh) {
    // Samples by area vary without bound near a mesh; irradiance does not.
    for (glm::length_t c = 0; c < 3; ++c) {
      const float most = pi * brightest[c];
      if (factor[c] * sum.level()[c] > most) factor[c] = most / sum.level()[c];
    }
  }
  sum.add_to(light, factor);
}

rays::IrradianceByNormal PosedLight::irradiance_by_normal(int group, const rays::SurfacePoint& point,
                                                          int samples) const {
  require(samples > 0, "direct light", "it needs one sample at least");
  const Receiver at = receiver(point);
  rays::IrradianceByNormal light(0);
  RayTask task;
  std::size_t k = 0;
  for (const GroupEmitter& emitter : emitters_of(group))
    add_by_normal(emitter, at, hash_combine(at.seed, k++), samples, task, light);
  data_->rays.add(task.rays);
  return light;
}

rays::IrradianceByNormal PosedLight::mirrored_by_normal(int group, const rays::SurfacePoint& point,
                                                        int samples) const {
  require(samples > 0, "direct light", "it needs one sample at least");
  const Receiver at = receiver(point);
  rays::IrradianceByNormal light(0);
  RayTask task;
  for_images(group, at, [&](const GroupEmitter& emitter, const Receiver& image, std::uint64_t seed) {
    if (emitter.emitter.kind == shading::EmitterKind::environment) {
      SumByNormal sum(at.normal);
      sample_mirrored_sky(emitter, image, seed, samples, task, [&](const vec3& toward, const vec3& weighted) {
        sum.add(toward, glm::dot(toward, at.normal) * weighted);
      });
      sum.add_to(light, vec3(1));
      return;
    }
    rays::IrradianceByNormal by_image(0);
    add_by_normal(emitter, image, seed, samples, task, by_image);
    for (glm::length_t c = 0; c < 3; ++c) {
      vec3 axis(0);
      axis[c] = 1;
      const vec3 turned = image.pane->mirrored_direction(axis);
      light[c] += turned.x * by_image[0] + turned.y * by_image[1] + turned.z * by_image[2];
    }
    light[3] += by_image[3];
  });
  data_->rays.add(task.rays);
  return light;
}

std::vector<rays::ArrivingLight> PosedLight::arriving(int group, const vec3& place, int samples) const {
  require(samples > 0, "direct light", "it needs one sample at least");
  std::vector<rays::ArrivingLight> light;
  RayTask task;
  std::size_t k = 0;
  for (const GroupEmitter& emitter : emitters_of(group)) {
    const std::uint64_t seed = hash_combine(position_seed(place), k++);
    const int count = emitter.emitter.delta() ? 1 : samples;
    for (int s = 0; s < count; ++s) {
      const auto sample = lights_.sample_emitter(emitter.index, place, sample_place(seed, s));
      if (!sample || !(sample->pdf > 0) || !(max_component(sample->radiance) > 0)) continue;
      const vec3 through = geometry_.transmittance(shadow_ray(place, place, *sample), 0, task);
      if (max_component(through) > 0)
        light.push_back({sample->wi, through * sample->radiance / (sample->pdf * static_cast<float>(count))});
    }
  }
  data_->rays.add(task.rays);
  return light;
}

std::vector<rays::ArrivingLight> PosedLight::mirrored_arriving(int group, const vec3& place,
                                                               int samples) const {
  require(samples > 0, "direct light", "it needs one sample at least");
  std::vector<rays::ArrivingLight> light;
  RayTask task;
  const Receiver at{place, vec3(0), place, position_seed(place)};
  for_images(group, at, [&](const GroupEmitter& emitter, const Receiver& image, std::uint64_t seed) {
    const auto add = [&](const vec3& toward, const vec3& irradiance) {
      if (max_component(irradiance) > 0) light.push_back({toward, irradiance});
    };
    if (emitter.emitter.kind == shading::EmitterKind::environment) {
      sample_mirrored_sky(emitter, image, seed, samples, task, add);
      return;
    }
    for (int s = 0; s < samples; ++s) {
      const auto sample = lights_.sample_emitter(emitter.index, image.position, sample_place(seed, s));
      if (!sample || !(sample->pdf > 0) || !(max_component(sample->radiance) > 0)) continue;
      add(image.pane->mirrored_direction(sample->wi), arriving_share(image, *sample, task) *
                                                          sample->radiance /
                                                          (sample->pdf * static_cast<float>(samples)));
    }
  });
  data_->rays.add(task.rays);
  return light;
}

}  // namespace ssphh::trace
