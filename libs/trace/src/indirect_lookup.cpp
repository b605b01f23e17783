#include "indirect_lookup.h"

#include <algorithm>

#include "mirror_lobe.h"

namespace ssphh::trace {

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

}  // namespace ssphh::trace
