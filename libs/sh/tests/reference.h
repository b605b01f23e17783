#pragma once
/// Slow, literal definitions of the spherical harmonics, to test the fast ones against.

#include <cmath>
#include <cstdlib>

#include <ssphh/core/math.h>

namespace ssphh::sh {

/// Associated Legendre function P_l^m(x), 0 ≤ m ≤ l, |x| ≤ 1, **without** the Condon–Shortley sign, by the
/// explicit sum P_l^m(x) = 2^−l (1 − x²)^{m/2} Σ_j (−1)^j (2l−2j)! / (j! (l−j)! (l−m−2j)!) x^{l−m−2j} (m-fold
/// derivative of Rodrigues' formula; Abramowitz & Stegun 8.6.6 and 22.3.8 with the sign (−1)^m left out).
inline double reference_legendre(int l, int m, double x) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  double sum = 0;
  for (int j = 0; 2 * j <= l - m; ++j) {
    const double term =
        factorial(2 * l - 2 * j) / (factorial(j) * factorial(l - j) * factorial(l - m - 2 * j));
    sum += (j % 2 ? -term : term) * std::pow(x, l - m - 2 * j);
  }
  return std::ldexp(sum, -l) * std::pow(1 - x * x, 0.5 * m);
}

/// Y_lm at polar angle θ from +z and azimuth φ from +x, −l ≤ m ≤ l: √2 K cos mφ P, K P or √2 K sin |m|φ P
/// (Green, Spherical Harmonic Lighting: The Gritty Details, 2003, eq. 6).
inline double reference_basis(int l, int m, double theta, double phi) {
  const int order = std::abs(m);
  const double k =
      std::sqrt((2 * l + 1) / (4 * pi_d) * std::tgamma(l - order + 1.0) / std::tgamma(l + order + 1.0));
  const double legendre = reference_legendre(l, order, std::cos(theta));
  if (m == 0) return k * legendre;
  return std::sqrt(2.0) * k * legendre * (m > 0 ? std::cos(order * phi) : std::sin(order * phi));
}

}  // namespace ssphh::sh
