#include "distant_lights.h"

#include <limits>

namespace ssphh::shading {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Unit +z axis of a node: where a directional light of it stands.
vec3 node_axis(const mat4& world) {
  const vec3 z(world[2]);
  const float length = glm::length(z);
  return length > 0 ? z / length : vec3(0, 0, 1);
}

}  // namespace

DistantLights::DistantLights(const scene::Scene& scene, const std::vector<mat4>& world,
                             const std::vector<std::string>& groups) {
  std::vector<float> directional_power, power;
  for (const scene::Light& light : scene.lights) {
    const vec3 irradiance = light.color * light.intensity;
    const float weight = luminance(irradiance);
    if (light.type != scene::LightType::directional || !(weight > 0)) continue;
    const vec3 to_light = node_axis(light.node < 0 ? mat4(1) : world[static_cast<std::size_t>(light.node)]);
    const int group = scene::light_group_index(groups, scene::light_group(light));
    const float sin_radius = std::sin(glm::min(light.angular_radius, pi / 2));
    if (sin_radius > 0) {
      const float sin2 = sin_radius * sin_radius;
      discs_.push_back({to_light, Frame::around(to_light), irradiance / (pi * sin2), Cone(sin2), group});
      power.push_back(weight);
    } else {
      directional_.push_back({to_light, irradiance, group});
      directional_power.push_back(weight);
    }
  }
  power.insert(power.begin(), directional_power.begin(), directional_power.end());
  if (scene.environment) {
    const int group = scene::light_group_index(groups, scene::light_group(*scene.environment));
    environments_.emplace_back(*scene.environment, group);
    power.push_back(environments_.back().mean_irradiance());
  }
  for (const float p : power) irradiance_ += p;
  // A share for each, so that the sky is not lost beside the sun
  for (float& p : power) p += p > 0 ? 0.1f * irradiance_ / static_cast<float>(power.size()) : 0.0f;
  choice_ = Distribution(power);
}

std::optional<LightSample> DistantLights::sample(float u_choice, const vec2& u) const {
  const Distribution::Choice choice = choice_.sample(u_choice);
  std::size_t i = choice.index;
  if (i < directional_.size()) {
    const DirectionalLight& light = directional_[i];
    return LightSample{light.to_light, infinity, light.irradiance, choice.probability, true, light.group};
  }
  i -= directional_.size();
  if (i < discs_.size()) {
    const DiscLight& light = discs_[i];
    const vec3 wi = light.frame.to_world(light.cone.sample(u));
    return LightSample{wi,    infinity,   light.radiance, choice.probability * light.cone.pdf(),
                       false, light.group};
  }
  const EnvironmentLight& light = environments_.front();
  const EnvironmentLight::Sample s = light.sample(u);
  if (!(s.pdf > 0)) return std::nullopt;
  return LightSample{s.wi, infinity, s.radiance, choice.probability * s.pdf, false, light.group()};
}

std::optional<EmitterHit> DistantLights::hit(int i, const vec3& direction) const {
  const auto index = static_cast<std::size_t>(i);
  if (index < discs_.size()) {
    const DiscLight& light = discs_[index];
    // |d − axis|² = 2 (1 − cos): compares narrow cones without cancellation
    const vec3 offset = direction - light.to_light;
    if (glm::dot(offset, offset) > 2 * light.cone.one_minus) return std::nullopt;
    const float probability = choice_.probability(directional_.size() + index);
    return EmitterHit{infinity, light.radiance, probability * light.cone.pdf(), light.group};
  }
  const EnvironmentLight& light = environments_.front();
  const std::size_t place = directional_.size() + discs_.size();
  const float probability = choice_.empty() ? 0 : choice_.probability(place);
  const float pdf = probability > 0 ? probability * light.pdf(direction) : 0;
  return EmitterHit{infinity, light.radiance(direction), pdf, light.group()};
}

}  // namespace ssphh::shading
