/// Light of emitters that a pane has mirrored: what the point's mirror image gets through the pane.

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>

#include "mirror_images.h"
#include "surface_gap.h"

namespace ssphh::trace {

std::optional<PosedLight::Receiver> PosedLight::mirrored_receiver(const Receiver& at,
                                                                  std::size_t index) const {
  const Pane& pane = data_->panes[index];
  const float above = pane.above(at.position);
  const float rounding = data_->gap + position_error(max_abs_component(at.position));
  if (!(std::abs(above) > 2 * rounding)) return std::nullopt;  // the pane itself, or what lies in its plane
  if (at.normal != vec3(0) && !(glm::dot(farthest(pane.bounds, at.normal) - at.position, at.normal) > 0))
    return std::nullopt;
  // Of a place in the open: all of the pane lies on this side
  const vec3 normal = at.normal != vec3(0) ? at.normal : (above > 0 ? -1.0f : 1.0f) * pane.normal;
  return Receiver{pane.mirrored(at.position), pane.mirrored_direction(normal), at.start,
                  hash_combine(at.seed, 0x9a4e5ull + index), &pane};
}

bool PosedLight::may_arrive(const GroupEmitter& light, const Receiver& image) const {
  const Pane& pane = *image.pane;
  const scene::Bounds& extent = light.emitter.extent;
  const bool distant = light.emitter.distant();

  // Some of it stands before the pane, on the side of the point.
  const vec3 outward = (pane.above(image.position) > 0 ? -1.0f : 1.0f) * pane.normal;
  const vec3 highest = farthest(extent, outward);
  if (!(glm::dot(distant ? highest : highest - pane.bounds.center(), outward) > 0)) return false;

  // The cones around both meet.
  const vec3 to_light = distant ? extent.center() : extent.center() - image.position;
  const vec3 to_pane = pane.bounds.center() - image.position;
  const float light_length = glm::length(to_light), pane_length = glm::length(to_pane);
  const float light_sine = extent.radius() / light_length, pane_sine = pane.bounds.radius() / pane_length;
  if (!(light_sine < 1 && pane_sine < 1)) return true;
  const float cosine = glm::dot(to_light, to_pane) / (light_length * pane_length);
  return std::acos(glm::clamp(cosine, -1.0f, 1.0f)) <= std::asin(light_sine) + std::asin(pane_sine) + 1e-3f;
}

void PosedLight::mirrored(int group, std::span<const rays::SurfacePoint> points, std::span<vec3> out) const {
  require(points.size() == out.size(), "direct light", "there is not one value for each point");
  emitters_of(group);  // throws where there is none
  parallel_for(points.size(), 32, [&](std::size_t begin, std::size_t end) {
    RayTask task;
    for (std::size_t i = begin; i < end; ++i) {
      const Receiver at = receiver(points[i]);
      vec3 sum(0);
      for_images(group, at, [&](const GroupEmitter& light, const Receiver& image, std::uint64_t seed) {
        if (light.emitter.kind != shading::EmitterKind::environment) {
          sum += irradiance_of(light, image, seed, task);
          return;
        }
        sample_mirrored_sky(
            light, image, seed, data_->options.environment_samples, task,
            [&](const vec3& toward, const vec3& weighted) { sum += glm::dot(toward, at.normal) * weighted; });
      });
      out[i] = sum;
    }
    data_->rays.add(task.rays);
  });
}

}  // namespace ssphh::trace
