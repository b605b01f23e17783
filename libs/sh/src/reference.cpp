#include <cmath>
#include <cstdlib>

#include <ssphh/core/require.h>
#include <ssphh/sh/reference.h>

namespace ssphh::sh {

double reference_legendre(int l, int m, double x) {
  require(0 <= m && m <= l, "Legendre function", "m must be 0..l");
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  double sum = 0;
  for (int j = 0; 2 * j <= l - m; ++j) {
    const double term =
        factorial(2 * l - 2 * j) / (factorial(j) * factorial(l - j) * factorial(l - m - 2 * j));
    sum += (j % 2 ? -term : term) * std::pow(x, l - m - 2 * j);
  }
  return std::ldexp(sum, -l) * std::pow(1 - x * x, 0.5 * m);
}

double reference_basis(int l, int m, double theta, double phi) {
  const int order = std::abs(m);
  const double k =
      std::sqrt((2 * l + 1) / (4 * pi_d) * std::tgamma(l - order + 1.0) / std::tgamma(l + order + 1.0));
  const double legendre = reference_legendre(l, order, std::cos(theta));
  if (m == 0) return k * legendre;
  return std::sqrt(2.0) * k * legendre * (m > 0 ? std::cos(order * phi) : std::sin(order * phi));
}

}  // namespace ssphh::sh
