#pragma once
/// Point, spot and sphere lights, and SPHLs that shine.

#include <memory>

#include <ssphh/shading/lights.h>

#include "distant_lights.h"
#include "lamp_shape.h"

namespace ssphh::shading {

/// Isotropic intensity, narrowed to a cone for spots and to a range if one is given; or the shape of an SPHL
/// or of a photometric profile.
struct PointLight {
  vec3 position{0};
  vec3 intensity{0};  ///< [W/sr]; where there is a shape, a factor on it
  vec3 axis{0};       ///< unit, direction of a spot; zero: point light
  float cone_scale = 0, cone_offset = 1;
  float range = 0;  ///< 0: unlimited
  int group = 0;
  std::shared_ptr<const LampShape> shape{};  ///< of an SPHL, or a profile within a spot's cones
  float radius = 0;  ///< of an SPHL: within it nothing shadows, and no light is nearer

  /// Cone and range factors of KHR_lights_punctual toward `wi`, which points to the light; 0..1.
  float falloff(const vec3& wi, float distance2) const;
  std::optional<LightSample> sample(const vec3& from) const;
  rays::Photon emit(const vec2& u_direction) const;
  /// Luminance of the irradiance on a facing plane.
  float importance(const vec3& from) const;
  /// Flux divided by 4π (luminance).
  float power() const;
};

/// Radiance in every direction from each point of a sphere, also inward; does not block.
struct SphereLight {
  vec3 center;
  float radius;
  vec3 radiance;
  int group = 0;

  std::optional<LightSample> sample(const vec3& from, const vec2& u) const;
  rays::Photon emit(const vec2& u_place, const vec2& u_direction) const;
  /// Solid-angle density of sample(), uniform over the directions that meet the sphere.
  float pdf(const vec3& from) const;
  /// Distance at which a ray meets the surface first; none within max_distance.
  std::optional<float> intersect(const vec3& origin, const vec3& direction, float max_distance) const;
  float importance(const vec3& from) const;
  float power() const;
};

/// Of emission that is not empty.
PointLight make_sphl_light(const PosedLight& posed, int group);
PointLight make_point_light(const scene::Light& light, const mat4& world, int group);
/// Of a point or spot light with a profile.
PointLight make_profile_light(const PosedLight& posed, int group);
SphereLight make_sphere_light(const scene::Light& light, const mat4& world, int group);

}  // namespace ssphh::shading
