#pragma once
/// Irradiance E(n) = ∫ L(ω) max(0, n·ω) dω from radiance coefficients: E[l,m] = A_l L[l,m] (Ramamoorthi &
/// Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001). No hidden 1/π: a
/// Lambertian surface of albedo ρ leaves ρ E/π.

#include <ssphh/core/math.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// A_l of the clamped cosine: π, 2π/3, π/4, 0, −π/24, 0, π/64, … (eq. 8 there), 0 ≤ l ≤ max_degree.
double cosine_band_factor(int l);

/// Exact cosine convolution of every band.
IrradianceSh irradiance_from_radiance(const RadianceSh& radiance);

/// E(n) [W m⁻²] for a unit normal.
vec3 irradiance(const RadianceSh& radiance, const vec3& normal);

/// The same up to degree 2 as a quadratic polynomial in n (eq. 13): c1 = 0.42904277, c2 = 0.51166335,
/// c3 = 0.74312387, c4 = 0.88622693, c5 = 0.24770796. Missing bands count as 0, higher ones are ignored.
vec3 irradiance_polynomial(const RadianceSh& radiance, const vec3& normal);

/// E_c(n) = (n,1)ᵀ M_c (n,1) for the channels c = R, G, B (eq. 11–12), as shaders use it. Bands as above.
struct IrradianceMatrices {
  mat4 channel[3];
};
IrradianceMatrices irradiance_matrices(const RadianceSh& radiance);
vec3 irradiance(const IrradianceMatrices& matrices, const vec3& normal);

}  // namespace ssphh::sh
