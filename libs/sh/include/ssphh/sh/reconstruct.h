#pragma once
/// The function back from its coefficients: f(ω) = Σ_k values[k] Y_k(ω).

#include <span>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// Radiance [W sr⁻¹ m⁻²] from the unit direction ω. Truncation rings: the result may be negative (window.h).
vec3 eval(const RadianceSh& radiance, const vec3& direction);

/// Irradiance [W m⁻²] on a surface with unit normal n.
vec3 eval(const IrradianceSh& irradiance, const vec3& normal);

/// Many directions: out[i] = eval(sh, directions[i]).
void eval(const RadianceSh& radiance, std::span<const vec3> directions, std::span<vec3> out);
void eval(const IrradianceSh& irradiance, std::span<const vec3> normals, std::span<vec3> out);

}  // namespace ssphh::sh
