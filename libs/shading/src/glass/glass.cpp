#include <ssphh/shading/glass.h>

#include "../bsdf/albedo_table.h"
#include "../bsdf/ggx.h"
#include "../bsdf/specular.h"
#include "fresnel.h"

namespace ssphh::shading {
namespace {

float mean_of(const vec3& v) {
  return (v.x + v.y + v.z) / 3;
}

/// Smith's masking of one direction; |cos| counts.
float ggx_masking(float alpha, float cosine) {
  const float c = std::abs(cosine);
  return 2 * c / (c + ggx_root(alpha, c));
}

/// What the lobe of rough glass keeps of its light: the directional albedo of GGX.
float lobe_share(const GlassParams& glass, float cosine) {
  if (is_smooth(glass)) return 1;
  const vec2 ab = albedo_table(false).directional(cosine, glass.roughness);
  return ab.x + ab.y;
}

vec3 mirrored(const vec3& w) {
  return {w.x, w.y, -w.z};
}

float index_beyond(const GlassParams& glass) {
  if (glass.sheet) return 1;
  return glass.inside ? 1 / glass.ior : glass.ior;
}

/// One polarisation in a sheet whose boundary reflects r.
void add_sheet(float r, const vec3& tint, GlassShares& sum) {
  const vec3 transmitted = (1 - r) * (1 - r) * tint / glm::max(vec3(1) - r * r * tint * tint, vec3(1e-12f));
  sum.transmitted += 0.5f * transmitted;
  sum.reflected += 0.5f * (vec3(r) + r * tint * transmitted);
}

}  // namespace

GlassShares glass_shares(const GlassParams& glass, float cosine) {
  const float eta = glass.inside && !glass.sheet ? 1 / glass.ior : glass.ior;
  const Polarised full = fresnel_reflectance(cosine, eta);
  const bool total = full.s == 1 && full.p == 1;
  const float weight = total ? 1 : glass.specular;
  GlassShares shares;
  if (glass.sheet) {
    add_sheet(weight * full.s, glass.tint, shares);
    add_sheet(weight * full.p, glass.tint, shares);
  } else {
    const float r = weight * 0.5f * (full.s + full.p);
    shares = {vec3(r), (1 - r) * glass.tint};
  }
  return shares;
}

vec3 straight_transmittance(const GlassParams& glass, float cosine) {
  GlassParams outside = glass;
  outside.inside = false;
  const vec3 transmitted = glass_shares(outside, cosine).transmitted;
  return lobe_share(glass, cosine) * transmitted;
}

vec3 sheet_reflectance(const GlassParams& glass, float cosine) {
  return lobe_share(glass, cosine) * glass_shares(glass, cosine).reflected;
}

bool is_smooth(const GlassParams& glass) {
  constexpr float refracts =
      1.001f;  // below, no microfacet turns light, and none can be told from its direction
  return alpha_of_roughness(glass.roughness) <= min_alpha || (!glass.sheet && glass.ior < refracts);
}

GlassFrom::GlassFrom(const GlassParams& glass, const vec3& wo)
    : glass_(glass),
      wo_(wo),
      smooth_(is_smooth(glass)),
      alpha_(alpha_of_roughness(glass.roughness)),
      eta_(index_beyond(glass)) {}

float GlassFrom::power() const {
  const GlassShares shares = glass_shares(glass_, wo_.z);
  return mean_of(shares.reflected) + (smooth_ && glass_.sheet ? 0 : mean_of(shares.transmitted));
}

float GlassFrom::reflection_chance(const GlassShares& shares) const {
  const float reflected = mean_of(shares.reflected);
  const float transmitted = smooth_ && glass_.sheet ? 0 : mean_of(shares.transmitted);
  const float all = reflected + transmitted;
  return all > 0 ? reflected / all : 0;
}

BsdfValue GlassFrom::eval(const vec3& wi) const {
  if (smooth_ || !(wo_.z > 0) || wi.z == 0) return {};
  return wi.z > 0 ? eval_reflected(wi) : eval_transmitted(wi);
}

BsdfValue GlassFrom::eval_reflected(const vec3& wi) const {
  const vec3 h = glm::normalize(wo_ + wi);
  const GlassShares shares = glass_shares(glass_, glm::dot(wo_, h));
  return {shares.reflected * ggx(alpha_, wo_, wi, h), reflection_chance(shares) * ggx_pdf(alpha_, wo_, h)};
}

// Of a sheet the reflected lobe turned over (KHR_materials_transmission); of a body Walter et al., Microfacet
// Models for Refraction through Rough Surfaces, 2007, equations 16, 17 and 21, with Smith's masking of either
// side.
BsdfValue GlassFrom::eval_transmitted(const vec3& wi) const {
  if (glass_.sheet) {
    const vec3 above = mirrored(wi), h = glm::normalize(wo_ + above);
    const GlassShares shares = glass_shares(glass_, glm::dot(wo_, h));
    return {shares.transmitted * ggx(alpha_, wo_, above, h),
            (1 - reflection_chance(shares)) * ggx_pdf(alpha_, wo_, h)};
  }
  vec3 h = wo_ + eta_ * wi;
  h *= (h.z < 0 ? -1 : 1) / glm::length(h);
  const float cos_o = glm::dot(wo_, h), cos_i = glm::dot(wi, h);
  if (!(cos_o > 0 && cos_i < 0)) return {};
  // A boundary reflects alike from either side; from inside, near total reflection, the refracted cosine is
  // lost to rounding.
  GlassParams outside = glass_;
  outside.inside = false;
  const GlassShares shares = glass_shares(outside, glass_.inside ? -cos_i : cos_o);
  const float root = cos_o + eta_ * cos_i;
  const float density = ggx_distribution(alpha_, h) * ggx_masking(alpha_, wo_.z) * cos_o / wo_.z;  // of h
  const float per_direction = -cos_i / (root * root);  // dω_h/dω_i over η²
  return {shares.transmitted * (density * ggx_masking(alpha_, wi.z) * per_direction),
          (1 - reflection_chance(shares)) * density * per_direction * eta_ * eta_};
}

std::optional<GlassSample> GlassFrom::sample_smooth(float u_lobe) const {
  const GlassShares shares = glass_shares(glass_, wo_.z);
  const float chance = reflection_chance(shares);
  if (u_lobe < chance) return GlassSample{{-wo_.x, -wo_.y, wo_.z}, shares.reflected / chance, 0};
  const float below = refracted_cosine(wo_.z, eta_);
  if (glass_.sheet || !(below > 0)) return std::nullopt;
  const float spread = 1 / (eta_ * eta_);
  return GlassSample{
      {-wo_.x / eta_, -wo_.y / eta_, -below}, shares.transmitted * (spread / (1 - chance)), 0, spread};
}

std::optional<GlassSample> GlassFrom::sample_mirrored(const vec2& u) const {
  if (!(wo_.z > 0)) return std::nullopt;
  if (smooth_) return GlassSample{{-wo_.x, -wo_.y, wo_.z}, glass_shares(glass_, wo_.z).reflected, 0};
  const vec3 h = sample_ggx_normal(alpha_, wo_, u);
  const vec3 wi = glm::normalize(2 * glm::dot(wo_, h) * h - wo_);
  const float pdf = ggx_pdf(alpha_, wo_, h);
  if (!(wi.z > 0 && pdf > 0)) return std::nullopt;
  const GlassShares shares = glass_shares(glass_, glm::dot(wo_, h));
  return GlassSample{wi, shares.reflected * (ggx(alpha_, wo_, wi, h) / pdf), pdf};
}

std::optional<GlassSample> GlassFrom::sample(float u_lobe, const vec2& u) const {
  if (!(wo_.z > 0)) return std::nullopt;
  if (smooth_) return sample_smooth(u_lobe);
  const vec3 h = sample_ggx_normal(alpha_, wo_, u);
  const float cos_h = glm::dot(wo_, h);
  if (!(cos_h > 0)) return std::nullopt;
  const bool reflects = u_lobe < reflection_chance(glass_shares(glass_, cos_h));
  vec3 wi = 2 * cos_h * h - wo_;
  float spread = 1;
  if (!reflects && glass_.sheet) {
    wi = mirrored(wi);
  } else if (!reflects) {
    const float below = refracted_cosine(cos_h, eta_);
    if (!(below > 0)) return std::nullopt;
    wi = (cos_h / eta_ - below) * h - wo_ / eta_;
    spread = 1 / (eta_ * eta_);
  }
  wi = glm::normalize(wi);
  if ((wi.z > 0) != reflects) return std::nullopt;
  const BsdfValue f = eval(wi);
  if (!(f.pdf > 0)) return std::nullopt;
  return GlassSample{wi, f.value / f.pdf, f.pdf, spread};
}

}  // namespace ssphh::shading
