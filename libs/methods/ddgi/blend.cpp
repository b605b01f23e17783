#include "blend.h"

#include <ssphh/core/octahedral.h>
#include <ssphh/core/parallel.h>

namespace ssphh::methods::ddgi {
namespace {

/// Sharpness of the cosine with which distances are weighed: narrow enough to tell walls apart.
float cosine_50(float cosine) {
  const float c2 = cosine * cosine, c4 = c2 * c2, c8 = c4 * c4, c16 = c8 * c8;
  return c16 * c16 * c16 * c2;
}

std::vector<vec3> texel_directions(int size) {
  std::vector<vec3> directions;
  for (int i = 0; i < size * size; ++i) directions.push_back(octahedral_texel(i, size));
  return directions;
}

vec3 power(const vec3& v, float exponent) {
  return exponent == 1 ? v : glm::pow(glm::max(v, vec3(0)), vec3(exponent));
}

vec3 blended(const vec3& old, const vec3& now, const DdgiBlend& params) {
  float stays = params.hysteresis;
  if (params.change > 0) {
    const float size = glm::max(max_component(old), max_component(now));
    const float change = max_component(glm::abs(now - old));
    if (change > params.change * size) stays *= change > 3 * params.change * size ? 0 : 0.25f;
  }
  const float inverse = 1 / params.gamma;
  return power(stays * power(old, inverse) + (1 - stays) * power(now, inverse), params.gamma);
}

}  // namespace

void blend_rays(DdgiField& field, std::span<const ProbeRay> rays, std::span<const vec3> directions,
                const DdgiBlend& params, std::span<std::uint8_t> fresh) {
  const std::vector<vec3> texels = texel_directions(DdgiField::irradiance_size);
  const std::vector<vec3> moment_texels = texel_directions(DdgiField::moment_size);
  // Farther walls cannot come between a probe and what it lights.
  const float farthest = 1.5f * glm::length(field.grid.spacing);
  std::vector<int> probes;
  for (std::size_t i = 0; i < field.active.size(); ++i) {
    if (field.active[i]) probes.push_back(static_cast<int>(i));
  }
  parallel_for(probes.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const std::span<const ProbeRay> own = rays.subspan(p * directions.size(), directions.size());
      DdgiBlend of_probe = params;
      std::uint8_t& is_fresh = fresh[probes[p]];
      if (is_fresh) of_probe.hysteresis = 0;
      is_fresh = 0;

      const std::span<vec3> irradiance = field.irradiance_of(probes[p]);
      for (std::size_t t = 0; t < texels.size(); ++t) {
        vec3 sum(0);
        float weights = 0;
        for (std::size_t r = 0; r < own.size(); ++r) {
          const float cosine = glm::dot(texels[t], directions[r]);
          if (!(cosine > 0)) continue;
          sum += cosine * own[r].radiance;
          weights += cosine;
        }
        if (weights > 0) irradiance[t] = blended(irradiance[t], pi / weights * sum, of_probe);
      }

      const std::span<vec2> moments = field.moments_of(probes[p]);
      for (std::size_t t = 0; t < moment_texels.size(); ++t) {
        vec2 sum(0);
        float weights = 0;
        for (std::size_t r = 0; r < own.size(); ++r) {
          const float cosine = glm::dot(moment_texels[t], directions[r]);
          if (!(cosine > 0)) continue;
          const float weight = cosine_50(cosine), distance = std::min(own[r].distance, farthest);
          sum += weight * vec2(distance, distance * distance);
          weights += weight;
        }
        if (weights > 1e-6f) moments[t] = glm::mix(sum / weights, moments[t], of_probe.hysteresis);
      }
    }
  });
}

}  // namespace ssphh::methods::ddgi
