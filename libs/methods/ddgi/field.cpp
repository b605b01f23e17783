#include "field.h"

#include <cmath>

#include "texel_blend.h"

namespace ssphh::methods::ddgi {

DdgiField::DdgiField(const ProbeGrid& probe_grid)
    : grid(probe_grid),
      active(static_cast<std::size_t>(grid.size()), 1),
      irradiance_texel(active.size() * irradiance_texels, vec3(0)),
      moment_texel(active.size() * moment_texels, vec2(0)) {
  for (int i = 0; i < grid.size(); ++i) position.push_back(grid.position(i));
}

std::size_t DdgiField::bytes() const {
  return position.size() * sizeof(vec3) + active.size() + irradiance_texel.size() * sizeof(vec3) +
         moment_texel.size() * sizeof(vec2);
}

/// Share of a probe's surroundings at a distance that it sees, after Chebyshev's inequality (Donnelly &
/// Lauritzen, Variance Shadow Maps, 2006); cubed, as Majercik et al. do, against leaks.
float DdgiField::seen(int probe, const vec3& from_probe, float distance) const {
  const TexelBlend blend = blend_texels(from_probe, moment_size);
  const vec2* texels = &moment_texel[static_cast<std::size_t>(probe) * moment_texels];
  vec2 moments(0);
  for (std::size_t k = 0; k < 4; ++k) moments += blend.weight[k] * texels[blend.texel[k]];
  if (distance <= moments.x) return 1;
  const float variance = std::abs(moments.x * moments.x - moments.y), beyond = distance - moments.x;
  const float bound = variance / (variance + beyond * beyond);
  return bound * bound * bound;
}

vec3 DdgiField::irradiance(const vec3& position_in, const vec3& normal, const vec3& wo,
                           const vec3& facing) const {
  const vec3 biased = position_in + (0.2f * normal + 0.8f * wo) * (0.75f * bias * grid.least_spacing());
  const vec3 cell = (biased - grid.first) / grid.spacing;
  const vec3 last = vec3(grid.count - 1);
  const vec3 low = glm::clamp(glm::floor(cell), vec3(0), glm::max(last - 1.0f, vec3(0)));
  const vec3 f = glm::clamp(cell - low, vec3(0), vec3(1));
  const TexelBlend texels = blend_texels(facing, irradiance_size);

  vec3 sum(0);
  float weights = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner / 2 & 1, corner / 4);
    const int probe = grid.index(glm::min(glm::ivec3(low) + step, grid.count - 1));
    if (!active[probe]) continue;
    const vec3& place = position[probe];

    // Probes behind the surface still count a little, for where it is curved or all others are hidden.
    const float cosine = glm::dot(glm::normalize(place - position_in + 1e-6f * normal), normal);
    const float half = 0.5f * (cosine + 1);
    float weight = half * half + 0.2f;
    const vec3 way = biased - place;
    const float distance = glm::length(way);
    if (visibility && distance > 0) weight *= seen(probe, way, distance);
    weight = glm::max(weight, 1e-6f);
    // Of what is hardly seen, still less: the eye is good at small light in the dark.
    constexpr float crush = 0.2f;
    if (weight < crush) weight *= weight * weight / (crush * crush);
    for (int axis = 0; axis < 3; ++axis) weight *= glm::max(step[axis] == 1 ? f[axis] : 1 - f[axis], 1e-3f);

    vec3 e(0);
    for (std::size_t k = 0; k < 4; ++k) {
      e += texels.weight[k] * irradiance_texel[probe * irradiance_texels + texels.texel[k]];
    }
    sum += weight * e;
    weights += weight;
  }
  return weights > 0 ? sum / weights : vec3(0);
}

}  // namespace ssphh::methods::ddgi
