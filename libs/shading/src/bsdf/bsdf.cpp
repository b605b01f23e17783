#include <ssphh/core/sphere.h>
#include <ssphh/shading/bsdf.h>

#include "albedo_table.h"
#include "disney_diffuse.h"
#include "lambert.h"
#include "oren_nayar.h"
#include "specular.h"

namespace ssphh::shading {
namespace {

bool has_specular(const BsdfParams& params) {
  return max_component(params.f0) > 0;
}

/// f · cos θ_i of the diffuse model for ρ = 1, as if there were no specular lobe.
float diffuse_model(float roughness, const vec3& wo, const vec3& wi) {
  if (roughness == 0) return lambert(wi);
  return roughness < 0 ? oren_nayar(glm::min(-roughness, 1.0f), wo, wi)
                       : disney_diffuse(glm::min(roughness, 1.0f), wo, wi);
}

/// Diffuse under specular: what the specular lobe leaves, on the way in and on the way out (Kelemen and
/// Szirmay-Kalos 2001), so that a Lambertian base gives exactly ρ (1 − E(μ_o)).
struct Layers {
  SpecularLobe specular;
  vec3 albedo;       ///< E(μ_o); only where there is a diffuse layer
  float p_specular;  ///< probability to sample the specular lobe

  Layers(const BsdfParams& params, const vec3& wo) : specular(params), albedo(0), p_specular(1) {
    if (!(max_component(params.diffuse) > 0)) return;
    albedo = specular_albedo(wo.z);

    // Choose the lobe by its share of the reflected light, neither starved when both are there
    const float s = albedo.x + albedo.y + albedo.z;
    const float d = glm::dot(params.diffuse, vec3(1) - albedo);
    if (d > 0) p_specular = glm::clamp(s / (s + d), 0.1f, 0.9f);
  }

  vec3 specular_albedo(float mu) const {
    const vec2 ab = albedo_table(specular.phong).directional(mu, specular.roughness);
    return glm::min(specular.f0 * ab.x + specular.f90 * ab.y, vec3(1));
  }
  vec3 transmitted(float mu_i) const {
    const vec2 ab = albedo_table(specular.phong).mean(specular.roughness);
    const vec3 mean = specular.f0 * ab.x + specular.f90 * ab.y;
    return (vec3(1) - albedo) * (vec3(1) - specular_albedo(mu_i)) / glm::max(vec3(1) - mean, vec3(1e-3f));
  }

  BsdfValue eval(const BsdfParams& params, const vec3& wo, const vec3& wi) const {
    const vec3 h = glm::normalize(wo + wi);
    BsdfValue result;
    result.value = specular.fresnel(glm::dot(wo, h)) * specular.eval(wo, wi, h);
    result.pdf = p_specular * specular.pdf(wo, h);
    if (p_specular < 1) {
      result.value += params.diffuse * transmitted(wi.z) * diffuse_model(params.diffuse_roughness, wo, wi);
      result.pdf += (1 - p_specular) * cosine_pdf(wi);
    }
    return result;
  }
};

}  // namespace

bool is_lambertian(const BsdfParams& params) {
  return params.diffuse_roughness == 0 && !has_specular(params);
}

BsdfValue eval_bsdf_and_pdf(const BsdfParams& params, const vec3& wo, const vec3& wi) {
  if (!(wo.z > 0 && wi.z > 0)) return {};
  if (!has_specular(params)) {
    return {params.diffuse * diffuse_model(params.diffuse_roughness, wo, wi), cosine_pdf(wi)};
  }
  return Layers(params, wo).eval(params, wo, wi);
}

vec3 eval_bsdf(const BsdfParams& params, const vec3& wo, const vec3& wi) {
  return eval_bsdf_and_pdf(params, wo, wi).value;
}

float pdf_bsdf(const BsdfParams& params, const vec3& wo, const vec3& wi) {
  return eval_bsdf_and_pdf(params, wo, wi).pdf;
}

std::optional<BsdfSample> sample_bsdf(const BsdfParams& params, const vec3& wo, float u_lobe, const vec2& u) {
  if (!(wo.z > 0)) return std::nullopt;

  // Without a specular lobe: cosine sampling
  if (!has_specular(params)) {
    const vec3 wi = sample_cosine_hemisphere(u);
    const float pdf = cosine_pdf(wi);
    if (!(pdf > 0)) return std::nullopt;
    const float scale =
        params.diffuse_roughness == 0 ? 1.0f : diffuse_model(params.diffuse_roughness, wo, wi) / pdf;
    return BsdfSample{wi, params.diffuse * scale, pdf};
  }

  // Sample one lobe, weigh by the density of both
  const Layers layers(params, wo);
  vec3 wi;
  if (u_lobe < layers.p_specular) {
    const vec3 h = layers.specular.sample_normal(wo, u);
    const float cos_h = glm::dot(wo, h);
    if (!(cos_h > 0)) return std::nullopt;
    wi = glm::normalize(2 * cos_h * h - wo);
  } else {
    wi = sample_cosine_hemisphere(u);
  }
  if (!(wi.z > 0)) return std::nullopt;
  const BsdfValue f = layers.eval(params, wo, wi);
  if (!(f.pdf > 0)) return std::nullopt;
  return BsdfSample{wi, f.value / f.pdf, f.pdf};
}

vec3 directional_albedo(const BsdfParams& params, float cos_o) {
  if (!has_specular(params)) return params.diffuse;
  const vec3 e = Layers(params, vec3(0, 0, 1)).specular_albedo(cos_o);
  return e + params.diffuse * (vec3(1) - e);
}

}  // namespace ssphh::shading
