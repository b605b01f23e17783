#include "punctual_lights.h"

#include <cmath>

#include <ssphh/core/sphere.h>

#include "cone.h"
#include "profile_intensity.h"
#include "shaped_intensity.h"

namespace ssphh::shading {
namespace {

/// Below this squared distance [m²] a point lies on a point light.
constexpr float least_distance2 = 1e-12f;

float square(float x) {
  return x * x;
}

}  // namespace

PointLight make_point_light(const scene::Light& light, const mat4& world, int group) {
  PointLight result;
  result.position = vec3(world[3]), result.intensity = light.color * light.intensity;
  result.range = light.range, result.group = group;
  if (light.type != scene::LightType::spot) return result;
  const vec3 back(world[2]);
  const float length = glm::length(back);
  result.axis = length > 0 ? -back / length : vec3(0, 0, -1);
  const ConeFalloff cone = cone_falloff(light);
  result.cone_scale = cone.scale, result.cone_offset = cone.offset;
  return result;
}

PointLight make_profile_light(const PosedLight& posed, int group) {
  PointLight result;
  result.position = vec3(posed.world[3]), result.intensity = posed.light.color * posed.light.intensity;
  result.range = posed.light.range, result.group = group;
  result.shape = std::make_shared<const ProfileIntensity>(posed.profile, posed.world);
  return result;
}

PointLight make_sphl_light(const PosedLight& posed, int group) {
  PointLight result = make_point_light(posed.light, posed.world, group);
  result.shape = std::make_shared<const ShapedIntensity>(posed.emission, posed.world);
  result.radius = posed.light.radius;
  return result;
}

float PointLight::falloff(const vec3& wi, float distance2) const {
  float factor = 1;
  if (cone_scale > 0) factor = square(glm::clamp(-glm::dot(axis, wi) * cone_scale + cone_offset, 0.0f, 1.0f));
  if (range > 0) factor *= glm::clamp(1 - square(distance2 / (range * range)), 0.0f, 1.0f);
  return factor;
}

std::optional<LightSample> PointLight::sample(const vec3& from) const {
  const vec3 d = position - from;
  const float distance2 = glm::dot(d, d);
  if (!(distance2 > least_distance2)) return std::nullopt;
  const float distance = std::sqrt(distance2);
  const vec3 wi = d / distance;
  const float factor = falloff(wi, distance2);
  if (!(factor > 0)) return std::nullopt;
  if (!shape) return LightSample{wi, distance, intensity * (factor / distance2), 1, true, group};
  const vec3 irradiance = intensity * shape->toward(-wi) * (factor / glm::max(distance2, radius * radius));
  if (!(max_component(irradiance) > 0)) return std::nullopt;
  return LightSample{wi, glm::max(distance - radius, 0.0f), irradiance, 1, true, group};
}

float PointLight::importance(const vec3& from) const {
  const vec3 d = position - from;
  const float distance2 = glm::max(glm::dot(d, d), least_distance2);
  const vec3 wi = d / std::sqrt(distance2);
  const float factor = cone_scale > 0 || range > 0 ? falloff(wi, distance2) : 1.0f;
  if (!shape) return luminance(intensity) * factor / distance2;
  // By the table of directions: 121 harmonics for each lamp at each point would be most of the work
  const float share = 4 * pi * shape->pdf(-wi);
  return luminance(intensity * shape->mean()) * share * factor / glm::max(distance2, radius * radius);
}

float PointLight::power() const {
  // Mean of the cone factor over the sphere: s² between the cone's cosines integrates to a third of their
  // difference
  if (shape) return luminance(intensity * shape->mean());
  float share = 1;
  if (cone_scale > 0) {
    const float cos_outer = -cone_offset / cone_scale;
    const float cos_inner = glm::min(cos_outer + 1 / cone_scale, 1.0f);
    share = 0.5f * ((1 - cos_inner) + (cos_inner - cos_outer) / 3);
  }
  return luminance(intensity) * share;
}

SphereLight make_sphere_light(const scene::Light& light, const mat4& world, int group) {
  return {vec3(world[3]), light.radius, light.color * light.intensity, group};
}

std::optional<LightSample> SphereLight::sample(const vec3& from, const vec2& u) const {
  const vec3 d = center - from;
  const float distance2 = glm::dot(d, d), radius2 = radius * radius;
  if (distance2 < radius2) {
    // From inside: every direction, as far as the surface
    const vec3 wi = sample_uniform_sphere(u);
    const float along = glm::dot(d, wi);
    const float exit = along + std::sqrt(glm::max(along * along + radius2 - distance2, 0.0f));
    return LightSample{wi, glm::max(exit, 0.0f), radiance, 1 / (4 * pi), false, group};
  }
  const Cone cone(radius2 / distance2);
  const float distance = std::sqrt(distance2);
  const vec3 local = cone.sample(u);
  const vec3 wi = Frame::around(d / distance).to_world(local);
  const float sin2 = local.x * local.x + local.y * local.y;
  const float to_surface = distance * local.z - std::sqrt(glm::max(radius2 - distance2 * sin2, 0.0f));
  return LightSample{wi, glm::max(to_surface, 0.0f), radiance, cone.pdf(), false, group};
}

float SphereLight::pdf(const vec3& from) const {
  const vec3 d = center - from;
  const float distance2 = glm::dot(d, d), radius2 = radius * radius;
  return distance2 < radius2 ? 1 / (4 * pi) : Cone(radius2 / distance2).pdf();
}

std::optional<float> SphereLight::intersect(const vec3& origin, const vec3& direction,
                                            float max_distance) const {
  const vec3 d = center - origin;
  const float along = glm::dot(d, direction);
  const vec3 miss =
      d - along * direction;  // from the ray's nearest point to the centre: exact also from far away
  const float half2 = radius * radius - glm::dot(miss, miss);
  if (!(half2 >= 0)) return std::nullopt;
  const float half = std::sqrt(half2);
  const bool inside = glm::dot(d, d) < radius * radius;
  const float t = inside ? along + half : along - half;
  if (!(t >= 0 && t < max_distance)) return std::nullopt;
  return t;
}

float SphereLight::importance(const vec3& from) const {
  const vec3 d = center - from;
  const float radius2 = radius * radius;
  return luminance(radiance) * pi * radius2 / glm::max(glm::dot(d, d), radius2);
}

float SphereLight::power() const {
  return luminance(radiance) * pi * radius * radius;
}

}  // namespace ssphh::shading
