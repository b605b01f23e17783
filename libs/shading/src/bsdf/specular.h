#pragma once
/// The specular lobe of a material: which model, how wide, which Fresnel term.

#include <ssphh/shading/bsdf.h>

#include "blinn_phong.h"
#include "disney_diffuse.h"
#include "ggx.h"

namespace ssphh::shading {

/// α of a perceptual roughness magnitude.
inline float alpha_of_roughness(float roughness) {
  return glm::clamp(roughness * roughness, min_alpha, 1.0f);
}

struct SpecularLobe {
  bool phong;
  float roughness;  ///< magnitude, 0..1
  float alpha;
  vec3 f0;
  float f90;  ///< by f90_per_f0

  explicit SpecularLobe(const BsdfParams& params)
      : phong(params.specular_roughness < 0),
        roughness(glm::min(std::abs(params.specular_roughness), 1.0f)),
        alpha(alpha_of_roughness(roughness)),
        f0(params.f0),
        f90(glm::min(1.0f, f90_per_f0 * max_component(params.f0))) {}

  /// Schlick's approximation.
  vec3 fresnel(float cos_h) const {
    const float s = schlick_weight(cos_h);
    return f0 * (1 - s) + f90 * s;
  }
  /// f · cos θ_i without Fresnel.
  float eval(const vec3& wo, const vec3& wi, const vec3& h) const {
    return phong ? blinn_phong(alpha, wo, wi, h) : ggx(alpha, wo, wi, h);
  }
  float pdf(const vec3& wo, const vec3& h) const {
    return phong ? blinn_phong_pdf(alpha, wo, h) : ggx_pdf(alpha, wo, h);
  }
  vec3 sample_normal(const vec3& wo, const vec2& u) const {
    return phong ? sample_blinn_phong_normal(alpha, u) : sample_ggx_normal(alpha, wo, u);
  }
};

}  // namespace ssphh::shading
