#pragma once
/// Reflection of a surface point. All directions are unit and in the local frame whose z axis is the shading
/// normal; wo points to the known (viewer's) side, wi to the sampled (light's) side. Reflection only: values
/// are zero unless wo.z > 0 and wi.z > 0.

#include <cstdint>
#include <optional>

#include <ssphh/core/sphere.h>

namespace ssphh::shading {

/// α, the square of a perceptual roughness, below which a lobe is not narrowed: a mirror is a lobe of ±0.06°,
/// and no special case anywhere.
inline constexpr float min_alpha = 1e-3f;
/// Reflectance at grazing incidence, at most 1, is so many times the one at normal incidence: nothing real
/// has an f0 below 0.02, so it means occlusion.
inline constexpr float f90_per_f0 = 50;
/// Nodes of the tabulated directional albedo of a specular lobe, in the cosine and in roughness.
inline constexpr int albedo_table_size = 32;

/// The material at one point, textures already looked up (see surface.h).
struct BsdfParams {
  vec3 diffuse{0.8f};            ///< diffuse albedo: base colour × (1 − metallic)
  vec3 f0{0.04f};                ///< specular reflectance at normal incidence, specular weight included
  float diffuse_roughness = 0;   ///< bipolar, see scene::Material
  float specular_roughness = 1;  ///< bipolar
};

/// A BSDF value and the density of sampling that direction.
struct BsdfValue {
  vec3 value{0};
  float pdf = 0;
};

struct BsdfSample {
  vec3 wi;
  vec3 weight;  ///< f · cos θ_i / pdf
  float pdf;    ///< as pdf_bsdf(params, wo, wi)
};

/// Which part of the reflection is meant: all of it; or the diffuse lobe, as dark as the specular lobe above
/// it leaves it.
enum class Lobes : std::uint8_t { all, diffuse };

/// The BSDF seen from one direction: what evaluating and sampling it have in common is computed once.
class BsdfFrom {
 public:
  BsdfFrom(const BsdfParams& params, const vec3& wo, Lobes lobes = Lobes::all)
      : params_(params),
        wo_(wo),
        specular_(max_component(params.f0) > 0),
        lambertian_(!specular_ && params.diffuse_roughness == 0) {
    if (specular_) weigh_layers(lobes);
  }

  /// As eval_bsdf and pdf_bsdf.
  BsdfValue eval(const vec3& wi) const {
    if (!(wo_.z > 0 && wi.z > 0)) return {};
    return lambertian_ ? BsdfValue{params_.diffuse * (wi.z / pi), wi.z / pi} : eval_lobes(wi);
  }
  /// As sample_bsdf.
  std::optional<BsdfSample> sample(float u_lobe, const vec2& u) const {
    if (!lambertian_) return sample_lobes(u_lobe, u);
    const vec3 wi = sample_cosine_hemisphere(u);
    if (!(wo_.z > 0 && wi.z > 0)) return std::nullopt;
    return BsdfSample{wi, params_.diffuse, wi.z / pi};
  }

 private:
  void weigh_layers(Lobes lobes);
  std::optional<BsdfSample> sample_lobes(float u_lobe, const vec2& u) const;
  BsdfValue eval_lobes(const vec3& wi) const;
  BsdfValue eval_layers(const vec3& wi) const;

  BsdfParams params_;
  vec3 wo_;
  bool specular_, lambertian_;
  float p_specular_ = 1;  ///< probability to sample the specular lobe; 0: it does not count
  vec3 left_{0};  ///< what the specular lobe leaves for the diffuse layer, but for its share toward wi
};

/// f(wo, wi) · cos θ_i, cosine included [sr⁻¹].
vec3 eval_bsdf(const BsdfParams& params, const vec3& wo, const vec3& wi);

/// Density with which sample_bsdf returns wi, in solid angle [sr⁻¹].
float pdf_bsdf(const BsdfParams& params, const vec3& wo, const vec3& wi);

/// eval_bsdf and pdf_bsdf in one, for little more than one of them.
BsdfValue eval_bsdf_and_pdf(const BsdfParams& params, const vec3& wo, const vec3& wi);

/// `u_lobe` in [0, 1) chooses the lobe, `u` in [0, 1)² the direction. Empty when wo is below the surface or
/// the sampled direction is: the path ends there.
std::optional<BsdfSample> sample_bsdf(const BsdfParams& params, const vec3& wo, float u_lobe, const vec2& u);

/// Whether all of the reflection is Lambertian: diffuse_roughness = 0 and f0 = 0.
bool is_lambertian(const BsdfParams& params);

/// ∫ f cos θ_i dω_i for the view cosine `cos_o`: exact for a Lambertian base, an estimate with the other
/// diffuse models.
vec3 directional_albedo(const BsdfParams& params, float cos_o);

}  // namespace ssphh::shading
