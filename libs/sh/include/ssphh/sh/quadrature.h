#pragma once
/// Integration over the sphere and over [−1, 1].

#include <cstdint>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::sh {

/// Nodes and weights of ∫₋₁¹ f(x) dx.
struct LineQuadrature {
  std::vector<double> nodes, weights;
};

/// Gauss–Legendre with `count` ≥ 1 nodes: exact for polynomials of degree ≤ 2·count − 1.
LineQuadrature gauss_legendre(int count);

/// Unit directions and weights [sr] that sum to 4π.
struct SphereQuadrature {
  std::vector<glm::dvec3> directions;
  std::vector<double> weights;
};

/// Gauss–Legendre in z times uniform azimuth: exact for spherical polynomials of degree ≤ `exact_degree`,
/// that is for the projection of a function of degree d to degree l when exact_degree ≥ d + l.
SphereQuadrature sphere_quadrature(int exact_degree);

/// Stratified Monte Carlo points: one uniformly jittered in each of side × side cells of equal solid angle
/// (Green, Spherical Harmonic Lighting: The Gritty Details, 2003). Unbiased; weights 4π / side².
SphereQuadrature stratified_sphere_samples(int side, std::uint64_t seed);

}  // namespace ssphh::sh
