#include "indirect_lookup.h"

#include <algorithm>
#include <cmath>

namespace ssphh::trace {

vec3 reflected_indirect(const rays::IndirectLight& indirect, const shading::Surface& surface,
                        const vec3& ray_origin, const vec3& wo, bool moves) {
  const vec3& n = surface.normal;
  const rays::SurfacePoint at{ray_origin, n, moves};
  const float cos_wo = std::max(glm::dot(n, wo), 0.0f);
  shading::BsdfParams specular = surface.bsdf;
  specular.diffuse = vec3(0);
  const vec3 e = shading::directional_albedo(specular, cos_wo);
  vec3 radiance(0);
  if (max_component(surface.bsdf.diffuse) > 0) {
    radiance = surface.bsdf.diffuse * (vec3(1) - e) / pi * indirect.irradiance(at);
  }
  if (max_component(e) > 0) {
    const float roughness = std::min(std::abs(surface.bsdf.specular_roughness), 1.0f);
    const vec3 mirror = glm::normalize(2 * glm::dot(n, wo) * n - wo);
    radiance += e * indirect.glossy(at, mirror, roughness);
  }
  return radiance;
}

}  // namespace ssphh::trace
