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

vec3 specular_albedo(const SpecularLobe& specular, float mu) {
  const vec2 ab = albedo_table(specular.phong).directional(mu, specular.roughness);
  return glm::min(specular.f0 * ab.x + specular.f90 * ab.y, vec3(1));
}

}  // namespace

// Diffuse under specular: what the specular lobe leaves, on the way in and on the way out (Kelemen and
// Szirmay-Kalos 2001), so that a Lambertian base gives exactly ρ (1 − E(μ_o)).

void BsdfFrom::weigh_layers(Lobes lobes) {
  if (lobes == Lobes::diffuse) p_specular_ = 0;
  if (!(max_component(params_.diffuse) > 0)) return;
  const SpecularLobe specular(params_);
  const vec3 albedo = specular_albedo(specular, wo_.z);
  const vec2 ab = albedo_table(specular.phong).mean(specular.roughness);
  const vec3 mean = specular.f0 * ab.x + specular.f90 * ab.y;
  left_ = (vec3(1) - albedo) / glm::max(vec3(1) - mean, vec3(1e-3f));
  if (lobes == Lobes::diffuse) return;

  // Choose the lobe by its share of the reflected light, neither starved when both are there
  const float s = albedo.x + albedo.y + albedo.z;
  const float d = glm::dot(params_.diffuse, vec3(1) - albedo);
  if (d > 0) p_specular_ = glm::clamp(s / (s + d), 0.1f, 0.9f);
}

BsdfValue BsdfFrom::eval_lobes(const vec3& wi) const {
  if (specular_) return eval_layers(wi);
  return {params_.diffuse * diffuse_model(params_.diffuse_roughness, wo_, wi), cosine_pdf(wi)};
}

BsdfValue BsdfFrom::eval_layers(const vec3& wi) const {
  const SpecularLobe specular(params_);
  BsdfValue result;
  if (p_specular_ > 0) {
    const vec3 h = glm::normalize(wo_ + wi);
    result.value = specular.fresnel(glm::dot(wo_, h)) * specular.eval(wo_, wi, h);
    result.pdf = p_specular_ * specular.pdf(wo_, h);
  }
  if (p_specular_ < 1) {
    const vec3 transmitted = left_ * (vec3(1) - specular_albedo(specular, wi.z));
    result.value += params_.diffuse * transmitted * diffuse_model(params_.diffuse_roughness, wo_, wi);
    result.pdf += (1 - p_specular_) * cosine_pdf(wi);
  }
  return result;
}

std::optional<BsdfSample> BsdfFrom::sample_lobes(float u_lobe, const vec2& u) const {
  if (!(wo_.z > 0)) return std::nullopt;

  // Without a specular lobe: cosine sampling
  if (!specular_) {
    const vec3 wi = sample_cosine_hemisphere(u);
    const float pdf = cosine_pdf(wi);
    if (!(pdf > 0)) return std::nullopt;
    const float scale = diffuse_model(params_.diffuse_roughness, wo_, wi) / pdf;
    return BsdfSample{wi, params_.diffuse * scale, pdf};
  }

  // Sample one lobe, weigh by the density of both
  vec3 wi;
  if (u_lobe < p_specular_) {
    const vec3 h = SpecularLobe(params_).sample_normal(wo_, u);
    const float cos_h = glm::dot(wo_, h);
    if (!(cos_h > 0)) return std::nullopt;
    wi = glm::normalize(2 * cos_h * h - wo_);
  } else {
    wi = sample_cosine_hemisphere(u);
  }
  if (!(wi.z > 0)) return std::nullopt;
  const BsdfValue f = eval_layers(wi);
  if (!(f.pdf > 0)) return std::nullopt;
  return BsdfSample{wi, f.value / f.pdf, f.pdf};
}

bool is_lambertian(const BsdfParams& params) {
  return params.diffuse_roughness == 0 && !has_specular(params);
}

BsdfValue eval_bsdf_and_pdf(const BsdfParams& params, const vec3& wo, const vec3& wi) {
  return BsdfFrom(params, wo).eval(wi);
}

vec3 eval_bsdf(const BsdfParams& params, const vec3& wo, const vec3& wi) {
  return eval_bsdf_and_pdf(params, wo, wi).value;
}

float pdf_bsdf(const BsdfParams& params, const vec3& wo, const vec3& wi) {
  return eval_bsdf_and_pdf(params, wo, wi).pdf;
}

std::optional<BsdfSample> sample_bsdf(const BsdfParams& params, const vec3& wo, float u_lobe, const vec2& u) {
  return BsdfFrom(params, wo).sample(u_lobe, u);
}

vec3 directional_albedo(const BsdfParams& params, float cos_o) {
  if (!has_specular(params)) return params.diffuse;
  const vec3 e = specular_albedo(SpecularLobe(params), cos_o);
  return e + params.diffuse * (vec3(1) - e);
}

}  // namespace ssphh::shading
