#pragma once
/// Signs of determinants of integer coordinates, without rounding: what a triangulation decides by.

#include <array>

#include <ssphh/core/math.h>

namespace ssphh::geometry {

/// Coordinates within ±lattice_range: then no determinant overflows 127 bits.
using LatticePoint = glm::ivec3;
inline constexpr int lattice_range = 1 << 20;

/// +1 where (b − a, c − a, d − a) is right-handed, −1 where it is left-handed, 0 where the four are coplanar.
int orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d);

/// +1 where e lies inside the sphere through a, b, c, d (of orientation +1), −1 outside, 0 on it.
int in_sphere(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d,
              const LatticePoint& e);

/// As in_sphere, but never 0 while a, b, c, d are not coplanar: each point's height on the paraboloid is
/// raised by an infinitesimal, the larger, the larger its rank (Devillers & Teillaud, Perturbations for
/// Delaunay and Weighted Delaunay 3D Triangulations, 2011). Cospherical points, as grids have them, are so
/// triangulated in one way and without flat tetrahedra. `points` are a, b, c, d, e; their ranks differ.
int in_sphere_perturbed(const std::array<LatticePoint, 5>& points, const std::array<int, 5>& ranks);

}  // namespace ssphh::geometry
