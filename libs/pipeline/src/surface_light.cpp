#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/pipeline/surface_light.h>

namespace ssphh::pipeline {

SurfaceLight::SurfaceLight(const trace::TransportScene& source, const trace::PathTracer& tracer,
                           const probes::ProbeSet& set, const probes::LookupParams& params, float time)
    : lookup_(probes::make_lookup(probes::LookupMethod::irradiance, set, tracer, params)),
      held_(lookup_->direct_groups()) {
  require(std::isfinite(time), "time", "it must be a finite number of seconds");
  std::vector<mat4> poses;
  for (int part = 0; part < source.part_count(); ++part) poses.push_back(source.part_pose(part, time));
  direct_ = source.direct_light(source.lights(time), poses);
  for (std::size_t g = 0; g < source.light_groups().size(); ++g) {
    const std::string& name = source.light_groups()[g];
    const auto group = std::ranges::find(set.light_groups, name, &probes::LightGroup::name);
    const vec3 scale = group == set.light_groups.end() ? vec3(1) : group->scale;
    if (std::ranges::find(held_, name) == held_.end() && scale != vec3(0))
      groups_.emplace_back(static_cast<int>(g), scale);
  }
}

vec3 SurfaceLight::direct(const rays::SurfacePoint& at, int samples) const {
  require(samples >= 1, "light of surfaces", "fewer than 1 sample");
  vec3 sum(0);
  for (const auto& [group, scale] : groups_) {
    sum += scale * direct_->irradiance_by_normal(group, at, samples)[3];
    if (direct_->mirrors()) sum += scale * direct_->mirrored_by_normal(group, at, samples)[3];
  }
  return sum;
}

}  // namespace ssphh::pipeline
