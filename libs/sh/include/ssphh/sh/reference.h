#pragma once
/// Slow, literal definitions of the spherical harmonics, kept as compiled code to test the fast ones against.

#include <ssphh/core/math.h>

namespace ssphh::sh {

/// Associated Legendre function P_l^m(x), 0 ≤ m ≤ l, |x| ≤ 1, **without** the Condon–Shortley sign, by the
/// explicit sum P_l^m(x) = 2^−l (1 − x²)^{m/2} Σ_j (−1)^j (2l−2j)! / (j! (l−j)! (l−m−2j)!) x^{l−m−2j} (m-fold
/// derivative of Rodrigues' formula; Abramowitz & Stegun 8.6.6 and 22.3.8 with the sign (−1)^m left out).
double reference_legendre(int l, int m, double x);

/// Y_lm at polar angle θ from +z and azimuth φ from +x, −l ≤ m ≤ l: √2 K cos mφ P, K P or √2 K sin |m|φ P
/// (Green, Spherical Harmonic Lighting: The Gritty Details, 2003, eq. 6).
double reference_basis(int l, int m, double theta, double phi);

}  // namespace ssphh::sh
