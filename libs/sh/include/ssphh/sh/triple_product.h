#pragma once
/// Products of spherical functions through the triple product (Gaunt) coefficients Γ_ijk = ∫ Y_i Y_j Y_k dω.

#include <vector>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// The nonzero Γ_ijk with i, j, k in the bands of three degrees.
class TripleProductTensor {
 public:
  struct Entry {
    std::uint8_t i, j, k;
    float value;
  };

  /// Each degree 0..max_degree. Computed exactly: azimuth in closed form, polar angle by Gauss–Legendre
  /// quadrature.
  TripleProductTensor(int degree_i, int degree_j, int degree_k);

  /// In ascending order of (i, j, k).
  const std::vector<Entry>& entries() const { return entries_; }

  /// Coefficients up to degree_k of f·g, where `f` has degree_i and `g`, a factor without unit (visibility,
  /// reflectance), degree_j. Exact when degree_k ≥ degree_i + degree_j, else its projection. The result has
  /// f's unit. Throws Error for factors of other degrees.
  template <class F, class G>
  RgbSh<F> product(const RgbSh<F>& f, const RgbSh<G>& g) const {
    require(f.degree() == degree_i_ && g.degree() == degree_j_, "triple product",
            "the factors' degrees are not those of the tensor");
    RgbSh<F> result(degree_k_);
    for (const Entry& e : entries_) result[e.k] += e.value * f[e.i] * g[e.j];
    return result;
  }

 private:
  int degree_i_, degree_j_, degree_k_;
  std::vector<Entry> entries_;
};

}  // namespace ssphh::sh
