#pragma once
/// Glass at a surface point: a thin sheet, or the boundary of a solid body. Directions are in the local frame
/// as in bsdf.h, whose z axis is the shading normal on the side of wo (wo.z > 0); wi.z < 0 is beyond the
/// surface.
///
/// What is evaluated is radiance: entering a denser medium it grows by the square of the index of refraction
/// n, so f(wo, wi) / n_o² = f(wi, wo) / n_i², and a path that comes out again where it went in has lost that
/// factor.

#include <optional>

#include <ssphh/shading/bsdf.h>

namespace ssphh::shading {

struct GlassParams {
  float share = 0;      ///< of the surface that is glass; the rest reflects as its BsdfParams say
  bool sheet = true;    ///< thin: both of its surfaces at once and no refraction; else the boundary of a body
  bool inside = false;  ///< wo lies within the body
  float ior = 1.5f;     ///< of the glass relative to what is around it, at least 1
  float specular = 1;   ///< weight of what is reflected, but for total reflection
  float roughness = 0;  ///< perceptual, 0..1, GGX
  vec3 tint{1};         ///< what passes keeps this share: of the sheet once, of a body at its boundary
  vec3 absorption{0};   ///< within the body [1/m]
};

/// Where light goes that meets glass in the direction of its (micro)normal; with tint 1 they sum to 1.
struct GlassShares {
  vec3 reflected{0}, transmitted{0};
};

/// By Fresnel's formulas for unpolarised light. A sheet reflects to and fro between its surfaces, for each
/// polarisation by itself: t = (1 − r)² τ / (1 − r² τ²), r + r t τ with τ the tint of one way. `cosine`: of
/// wo, 0..1.
GlassShares glass_shares(const GlassParams& glass, float cosine);

/// What passes when light goes on straight, whatever the kind of glass: `transmitted` of a sheet; of a body
/// as light that comes from outside, for its refraction would turn back by as much. Of rough glass, as much
/// of it as its lobe keeps (the directional albedo of GGX).
vec3 straight_transmittance(const GlassParams& glass, float cosine);

/// What a sheet mirrors, 0..1: `reflected`; of a rough one, as much of it as its lobe keeps.
vec3 sheet_reflectance(const GlassParams& glass, float cosine);

/// Whether it shows things sharply: mirrors and refracts in one direction, of which no density can be told.
bool is_smooth(const GlassParams& glass);

struct GlassSample {
  vec3 wi;
  vec3 weight;       ///< f · |cos θ_i| / pdf
  float pdf;         ///< 0 where the glass is smooth
  float spread = 1;  ///< (n_o/n_i)², which is in `weight`: a change of radiance that is no change of power
};

/// Glass seen from one direction, of all of the surface (share 1). What goes straight through a smooth sheet
/// is left to straight_transmittance().
class GlassFrom {
 public:
  GlassFrom(const GlassParams& glass, const vec3& wo);

  /// f · |cos θ_i| and the density of sample(), on both sides; zero where the glass is smooth.
  BsdfValue eval(const vec3& wi) const;
  /// Empty where the direction drawn lies on the wrong side, or nothing goes anywhere.
  std::optional<GlassSample> sample(float u_lobe, const vec2& u) const;
  /// Samples what is mirrored alone.
  std::optional<GlassSample> sample_mirrored(const vec2& u) const;
  /// Mean over the channels of the light that sample() spreads, seen from wo: near enough to divide samples
  /// by.
  float power() const;

 private:
  float reflection_chance(const GlassShares& shares) const;
  BsdfValue eval_reflected(const vec3& wi) const;
  BsdfValue eval_transmitted(const vec3& wi) const;
  std::optional<GlassSample> sample_smooth(float u_lobe) const;

  GlassParams glass_;
  vec3 wo_;
  bool smooth_;
  float alpha_;
  float eta_;  ///< index of refraction beyond the surface over that on the side of wo; 1 for sheets
};

}  // namespace ssphh::shading
