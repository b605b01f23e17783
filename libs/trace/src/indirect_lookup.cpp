#include "indirect_lookup.h"

#include <algorithm>
#include <cmath>

namespace ssphh::trace {
namespace {

shading::BsdfParams specular_lobe(const shading::Surface& surface) {
  shading::BsdfParams lobe = surface.bsdf;
  lobe.diffuse = vec3(0);
  return lobe;
}

float roughness_of(const shading::Surface& surface) {
  return std::min(std::abs(surface.bsdf.specular_roughness), 1.0f);
}

}  // namespace

vec3 reflected_indirect(const rays::IndirectLight& indirect, const shading::Surface& surface,
                        const vec3& ray_origin, const vec3& wo, bool moves, float followed) {
  const vec3& n = surface.normal;
  const rays::SurfacePoint at{ray_origin, n, moves};
  const float cos_wo = std::max(glm::dot(n, wo), 0.0f);
  const vec3 e = shading::directional_albedo(specular_lobe(surface), cos_wo);
  vec3 radiance(0);
  if (max_component(surface.bsdf.diffuse) > 0) {
    radiance = surface.bsdf.diffuse * (vec3(1) - e) / pi * indirect.irradiance(at);
  }
  if (followed < 1 && max_component(e) > 0) {
    const vec3 mirror = glm::normalize(2 * glm::dot(n, wo) * n - wo);
    radiance += (1 - followed) * e * indirect.glossy(at, mirror, roughness_of(surface));
  }
  return radiance;
}

float followed_share(const shading::Surface& surface) {
  constexpr float all = 0.4f, none = 0.6f;  // roughness
  if (!(max_component(surface.bsdf.f0) > 0)) return 0;
  return std::clamp((none - roughness_of(surface)) / (none - all), 0.0f, 1.0f);
}

std::optional<MirrorRay> sample_mirror(const shading::Surface& surface, const vec3& wo, float u_lobe,
                                       const vec2& u, float u_end) {
  constexpr float brightest = 8;  // a lobe of an eighth of what is reflected is always followed
  const Frame frame = Frame::around(surface.normal);
  const vec3 local = frame.to_local(wo);
  const shading::BsdfParams lobe = specular_lobe(surface);
  const float e = max_component(shading::directional_albedo(lobe, std::max(local.z, 0.0f)));
  const float chance = std::min(brightest * e / (e + max_component(surface.bsdf.diffuse)), 1.0f);
  if (!(u_end < chance)) return std::nullopt;
  const auto sample = shading::BsdfFrom(lobe, local).sample(u_lobe, u);
  if (!sample || !(sample->pdf > 0)) return std::nullopt;
  const vec3 direction = frame.to_world(sample->wi);
  if (!(glm::dot(direction, surface.geometric_normal) > 0)) return std::nullopt;
  return MirrorRay{direction, sample->weight / chance};
}

}  // namespace ssphh::trace
