#include "patch_light.h"

#include <algorithm>

#include <ssphh/core/parallel.h>

namespace ssphh::methods::vct {

void PatchLight::reset(std::size_t patches, std::size_t groups) {
  groups_.assign(groups, std::vector<vec3>(patches, vec3(0)));
}

std::size_t PatchLight::update(int group, const PatchSet& set, const rays::DirectLight& light,
                               const std::vector<scene::Bounds>* moved) {
  std::vector<std::uint8_t> wanted(set.patches.size(), 1);
  const auto samples_of = [&](const Patch& patch) {
    return std::span(set.samples).subspan(patch.first_sample, patch.samples);
  };
  if (moved) {
    parallel_for(wanted.size(), 1024, [&](std::size_t i) {
      wanted[i] = std::ranges::any_of(samples_of(set.patches[i]), [&](const rays::SurfacePoint& point) {
        return std::ranges::any_of(
            *moved, [&](const scene::Bounds& box) { return light.may_shadow(group, point, box); });
      });
    });
  }
  std::vector<rays::SurfacePoint> points;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto samples = samples_of(set.patches[i]);
    if (wanted[i]) points.insert(points.end(), samples.begin(), samples.end());
  }
  std::vector<vec3> values(points.size());
  light.irradiance(group, points, values);
  std::size_t next = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    vec3 sum(0);
    for (std::uint32_t s = 0; s < set.patches[i].samples; ++s) sum += values[next++];
    groups_[group][i] = sum / static_cast<float>(set.patches[i].samples);
  }
  return points.size();
}

void PatchLight::sum(std::span<const vec3> group_scales, std::vector<vec3>& out) const {
  for (vec3& e : out) e = vec3(0);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += group_scales[g] * groups_[g][i];
  }
}

std::size_t PatchLight::bytes() const {
  std::size_t sum = 0;
  for (const std::vector<vec3>& group : groups_) sum += group.size() * sizeof(vec3);
  return sum;
}

}  // namespace ssphh::methods::vct
