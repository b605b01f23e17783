#pragma once
/// Delaunay tetrahedralisation of points on an integer lattice.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/geometry/exact_predicates.h>

namespace ssphh::geometry {

struct Tetrahedron {
  std::array<std::int32_t, 4> vertex;  ///< orientation +1
  /// neighbor[k] lies across the face opposite of vertex[k]; −1: nothing, the face is of the hull.
  std::array<std::int32_t, 4> neighbor;
};

/// Bowyer–Watson (Computing Dirichlet Tessellations, 1981) with exact signs and cells to a vertex at
/// infinity. Throws Error for points that are equal, all in one plane or outside the lattice. A pure function
/// of the points and their order; cospherical points are triangulated as if the later ones were raised.
std::vector<Tetrahedron> delaunay(std::span<const LatticePoint> points);

/// Indices of four points that span space, found greedily; fewer where the points span less.
std::vector<std::int32_t> spanning_points(std::span<const LatticePoint> points);

}  // namespace ssphh::geometry
