#pragma once
/// Values of the real, orthonormal spherical harmonics Y_lm without Condon–Shortley sign
/// (docs/conventions.md#spherical-harmonics): Y₀₀ = 0.282095, Y₁₋₁ = 0.488603 y, Y₁₀ = 0.488603 z, Y₁₁ =
/// 0.488603 x.
///
/// Method: Y_l±m = p_lm(z) · {Re, Im}(x + iy)^m, where p_lm is the normalised associated Legendre function
/// divided by sin^m θ, by the three-term recurrence in l (Sloan, Efficient Spherical Harmonic Evaluation,
/// JCGT 2013, gives the same scheme unrolled). No trigonometry, no singularity at the poles. The slow
/// definition stands in reference.h.

#include <span>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// out[coefficient_index(l, m)] = Y_lm(direction) for all l ≤ degree. `direction` must be a unit vector and
/// `out` hold at least coefficient_count(degree) values. Error below 2e-6 at degree 10 (single), 1e-14
/// (double).
void eval_basis(int degree, const vec3& direction, std::span<float> out);
void eval_basis(int degree, const glm::dvec3& direction, std::span<double> out);

/// Many directions at once, as structure of arrays: direction i is (x[i], y[i], z[i]), a unit vector, and
/// out[k · count + i] = Y_k of it, with count = x.size(). Eight directions are evaluated side by side (SIMD).
void eval_basis(int degree, std::span<const float> x, std::span<const float> y, std::span<const float> z,
                std::span<float> out);

}  // namespace ssphh::sh
