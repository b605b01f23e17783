#pragma once
/// Rotation of spherical functions: (R f)(ω) = f(R⁻¹ω), so that a lobe toward d becomes the same lobe toward
/// R d. Each band rotates by its own (2l+1)² matrix, built from the one below (Ivanic & Ruedenberg, Rotation
/// Matrices for Real Spherical Harmonics, J. Phys. Chem. 1996, with the corrected Table 2 of the 1998
/// additions and corrections).

#include <vector>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// The band matrices of one rotation, to be applied to many functions.
class Rotation {
 public:
  /// `matrix` must be orthogonal; a mirroring (determinant −1) is allowed.
  Rotation(int degree, const glm::dmat3& matrix);
  Rotation(int degree, const quat& rotation);
  /// By `angle` radians, counter-clockwise seen against the axis (any length but 0).
  static Rotation about_axis(int degree, const vec3& axis, double angle);

  int degree() const { return degree_; }
  /// Element (m, n) of band l: R Y_ln = Σ_m element(l, m, n) Y_lm.
  double element(int l, int m, int n) const { return band(l)[(m + l) * (2 * l + 1) + n + l]; }

  /// The rotated function; sh.degree() ≤ degree().
  RadianceSh apply(const RadianceSh& sh) const;
  IrradianceSh apply(const IrradianceSh& sh) const;

 private:
  const double* band(int l) const { return elements_.data() + l * (2 * l - 1) * (2 * l + 1) / 3; }

  int degree_;
  std::vector<double> elements_;  ///< bands 0..degree, each row-major
};

/// Rotation(sh.degree(), rotation).apply(sh).
RadianceSh rotate(const RadianceSh& sh, const quat& rotation);

}  // namespace ssphh::sh
