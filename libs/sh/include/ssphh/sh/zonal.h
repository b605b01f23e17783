#pragma once
/// Zonal harmonics: functions symmetric about an axis. A lobe toward +z has only the coefficients z_l of
/// Y_l0.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// z_l = ∫ f(cos θ) Y_l0 dω for l = 0..degree.
using ZonalSh = std::vector<double>;

/// Coefficients of any function of cos θ by Gauss–Legendre quadrature with `nodes` nodes on [from, 1]; f
/// counts as 0 below `from` (a kink or jump belongs there: then the rule is exact for polynomials of degree ≤
/// 2·nodes − 1 − degree).
ZonalSh zonal_from_function(int degree, const std::function<double(double)>& f, double from = -1,
                            int nodes = 64);

/// The clamped cosine max(0, cos θ).
ZonalSh zonal_cosine_lobe(int degree);

/// f(cos θ) = Σ z_l Y_l0.
double eval_zonal(const ZonalSh& zonal, double cos_theta);

/// Coefficients of the lobe turned from +z to the unit direction `axis`: √(4π/(2l+1)) z_l Y_lm(axis) (Sloan,
/// Stupid Spherical Harmonics Tricks, GDC 2008). out holds coefficient_count(zonal.size() − 1) values.
void rotate_zonal(const ZonalSh& zonal, const vec3& axis, std::span<float> out);

/// (f ∗ z)(ω) = ∫ f(ω′) z(ω·ω′) dω′: each band times √(4π/(2l+1)) z_l (Driscoll & Healy 1994). Bands that the
/// kernel lacks become 0. The unit stays that of f (times sr, if the kernel is not normalised).
RadianceSh convolve(const RadianceSh& sh, const ZonalSh& kernel);

/// Lobes of glossy reflection about the mirror direction, normalised to 1 (band 0 is unchanged).
/// λ_l of the GGX lobe with view = normal = mirror direction, weighted by n·l, as prefiltered environment
/// maps use it (Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course): λ_l = ⟨P_l(cos θ)⟩. `alpha` =
/// roughness², > 0.
double ggx_band_scale(double alpha, int l);

/// λ_l of a spherical Gaussian of the diffusion kind, exp(−l (l+1) σ² / 2), σ in radians (Ramamoorthi &
/// Hanrahan, A Signal-Processing Framework for Inverse Rendering, SIGGRAPH 2001, give this form for
/// Torrance–Sparrow lobes).
double gaussian_band_scale(double sigma, int l);

/// The factors of bands 0..max_degree for a lookup at the mirror direction, from a table of ggx_band_scale
/// over perceptual roughness 0..1 (clamped), error below 1e-3. Roughness 0 leaves the function as it is.
std::array<float, max_degree + 1> glossy_band_scales(float roughness);
inline float glossy_band_scale(float roughness, int l) {
  return glossy_band_scales(roughness)[l];
}

/// Radiance averaged over the glossy lobe about the unit direction `mirror`.
vec3 eval_glossy(const RadianceSh& radiance, const vec3& mirror, float roughness);

}  // namespace ssphh::sh
