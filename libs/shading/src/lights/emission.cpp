/// Photons of each type of light: their power is what the light emits, divided by the density of the choice.

#include <cmath>

#include <ssphh/core/sphere.h>

#include "distant_lights.h"
#include "mesh_light.h"
#include "punctual_lights.h"
#include "triangle_map.h"

namespace ssphh::shading {

rays::Photon PointLight::emit(const vec2& u) const {
  if (shape) {
    const LampShape::Direction chosen = shape->sample(u);
    return {position + radius * chosen.direction, chosen.direction,
            intensity * shape->toward(chosen.direction) / chosen.pdf, range};
  }
  if (!(cone_scale > 0)) return {position, sample_uniform_sphere(u), 4 * pi * intensity, range};
  const float one_minus = 1 + cone_offset / cone_scale, x = u.x * one_minus;
  const vec3 local(std::sqrt(glm::max(x * (2 - x), 0.0f)) * unit_circle(u.y), 1 - x);
  const vec3 direction = Frame::around(axis).to_world(local);
  return {position, direction, 2 * pi * one_minus * falloff(-direction, 0) * intensity, range};
}

rays::Photon SphereLight::emit(const vec2& u_place, const vec2& u_direction) const {
  const vec3 n = sample_uniform_sphere(u_place);
  return {center + radius * n, Frame::around(n).to_world(sample_cosine_hemisphere(u_direction)),
          4 * pi * pi * radius * radius * radiance};
}

std::optional<EmittedPhoton> MeshLight::emit(const vec2& u_place, const vec2& u_direction) const {
  const Distribution::Choice choice = choice_.sample(u_place.x);
  const Triangle& triangle = triangles_[choice.index];
  const vec2 b = square_to_triangle(vec2(choice.u, u_place.y));
  const vec3 emitted = radiance(choice.index, b);
  if (!(max_component(emitted) > 0)) return std::nullopt;
  vec3 normal = triangle.normal;
  vec2 u = u_direction;
  float sides = 1;
  if (material_->double_sided) {
    sides = 2;
    u.x *= 2;
    if (u.x >= 1) u.x -= 1, normal = -normal;
  }
  const vec3 direction = Frame::around(normal).to_world(sample_cosine_hemisphere(u));
  return EmittedPhoton{{triangle.p0 + b.x * triangle.e1 + b.y * triangle.e2, direction,
                        emitted * (sides * pi * triangle.area / choice.probability)},
                       normal};
}

float DistantLights::flux(std::size_t i, float radius) const {
  const float disc = pi * radius * radius;
  if (i < directional_.size()) return luminance(directional_[i].irradiance) * disc;
  i -= directional_.size();
  if (i < discs_.size()) return luminance(discs_[i].radiance) / discs_[i].cone.pdf() * disc;
  return 4 * environment_->mean_irradiance() * disc;
}

std::optional<rays::Photon> DistantLights::emit(std::size_t i, const vec2& u_place, const vec2& u_direction,
                                                const vec3& center, float radius) const {
  const auto sample = sample_one(i, u_direction);
  if (!sample || !(max_component(sample->radiance) > 0)) return std::nullopt;
  const Frame frame = Frame::around(sample->wi);
  const vec2 place = radius * std::sqrt(u_place.x) * unit_circle(u_place.y);
  return rays::Photon{center + radius * sample->wi + place.x * frame.x + place.y * frame.y, -sample->wi,
                      sample->radiance * (pi * radius * radius / sample->pdf)};
}

}  // namespace ssphh::shading
