#include "distant_lights.h"

#include <algorithm>
#include <limits>
#include <numeric>

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

void DistantLights::assign(std::span<const PosedLight> lights,
                           std::shared_ptr<const EnvironmentLight> environment) {
  environment_ = std::move(environment);
  directional_.clear();
  discs_.clear();
  for (const PosedLight& posed : lights) {
    const scene::Light& light = posed.light;
    const vec3 irradiance = light.color * light.intensity;
    if (light.type != scene::LightType::directional || !(luminance(irradiance) > 0)) continue;
    const vec3 to_light = node_axis(posed.world);
    const int group = posed.group;
    const float sin_radius = std::sin(glm::min(light.angular_radius, pi / 2));
    if (sin_radius > 0) {
      const float sin2 = sin_radius * sin_radius;
      discs_.push_back(
          {to_light, Frame::around(to_light), irradiance / (pi * sin2), Cone(sin2), irradiance, group});
    } else {
      directional_.push_back({to_light, irradiance, group});
    }
  }
  divide_choices();
}

DistantLights DistantLights::without(std::span<const int> groups) const {
  const auto is_one = [&](int group) { return std::ranges::find(groups, group) != groups.end(); };
  DistantLights rest = *this;
  std::erase_if(rest.directional_, [&](const DirectionalLight& light) { return is_one(light.group); });
  std::erase_if(rest.discs_, [&](const DiscLight& light) { return is_one(light.group); });
  if (environment_ && is_one(environment_->group())) rest.environment_.reset();
  rest.divide_choices();
  return rest;
}

void DistantLights::divide_choices() {
  std::vector<float>& power = power_;
  power.clear();
  for (const DirectionalLight& light : directional_) power.push_back(luminance(light.irradiance));
  for (const DiscLight& light : discs_) power.push_back(luminance(light.irradiance));
  if (environment_) power.push_back(environment_->mean_irradiance());
  const float all = std::accumulate(power.begin(), power.end(), 0.0f);
  // A share for each, so that the sky is not lost beside the sun
  for (float& p : power) p += p > 0 ? 0.1f * all / static_cast<float>(power.size()) : 0.0f;
  choice_.assign(power);
}

std::optional<LightSample> DistantLights::sample(float u_choice, const vec2& u) const {
  const Distribution::Choice choice = choice_.sample(u_choice);
  auto sample = sample_one(choice.index, u);
  if (sample) sample->pdf *= choice.probability;
  return sample;
}

std::optional<LightSample> DistantLights::sample_one(std::size_t i, const vec2& u) const {
  if (i < directional_.size()) {
    const DirectionalLight& light = directional_[i];
    return LightSample{light.to_light, infinity, light.irradiance, 1, true, light.group};
  }
  i -= directional_.size();
  if (i < discs_.size()) {
    const DiscLight& light = discs_[i];
    const vec3 wi = light.frame.to_world(light.cone.sample(u));
    return LightSample{wi, infinity, light.radiance, light.cone.pdf(), false, light.group};
  }
  const EnvironmentLight::Sample s = environment_->sample(u);
  if (!(s.pdf > 0)) return std::nullopt;
  return LightSample{s.wi, infinity, s.radiance, s.pdf, false, environment_->group()};
}

std::optional<EmitterHit> DistantLights::hit(int i, const vec3& direction) const {
  const std::size_t place = directional_.size() + static_cast<std::size_t>(i);
  auto hit = radiance_of(place, direction);
  if (hit) hit->pdf *= choice_.empty() ? 0 : choice_.probability(place);
  return hit;
}

std::optional<EmitterHit> DistantLights::radiance_of(std::size_t i, const vec3& direction) const {
  if (i < directional_.size()) return std::nullopt;
  i -= directional_.size();
  if (i < discs_.size()) {
    const DiscLight& light = discs_[i];
    // |d − axis|² = 2 (1 − cos): compares narrow cones without cancellation
    const vec3 offset = direction - light.to_light;
    if (glm::dot(offset, offset) > 2 * light.cone.one_minus) return std::nullopt;
    return EmitterHit{infinity, light.radiance, light.cone.pdf(), light.group};
  }
  return EmitterHit{infinity, environment_->radiance(direction), environment_->pdf(direction),
                    environment_->group()};
}

Emitter DistantLights::emitter(std::size_t i) const {
  if (i < directional_.size()) {
    const DirectionalLight& light = directional_[i];
    return {EmitterKind::directional, light.group, {light.to_light, light.to_light}};
  }
  i -= directional_.size();
  if (i < discs_.size()) {
    // |d − axis| of its directions, as above
    const DiscLight& light = discs_[i];
    const vec3 reach(1.001f * std::sqrt(2 * light.cone.one_minus));
    return {EmitterKind::disc, light.group, {light.to_light - reach, light.to_light + reach}};
  }
  return {EmitterKind::environment, environment_->group(), {vec3(-1), vec3(1)}};
}

}  // namespace ssphh::shading
