#pragma once
/// Barycentric interpolation among points in space (Cupisz, Light Probe Interpolation Using Tetrahedral
/// Tessellations, GDC 2012).

#include <span>
#include <vector>

#include <ssphh/geometry/delaunay.h>
#include <ssphh/geometry/triangle_tree.h>
#include <ssphh/probes/lookup_weights.h>

namespace ssphh::methods::probe_volume {

/// Four points at most.
using CornerWeights = probes::WeightList<4>;

class Tetrahedra {
 public:
  /// One point or more. Points are rounded to a lattice of 2¹⁹ places along the longest edge of their box;
  /// those that fall together count as the first of them. Points that lie in a plane or on a line within a
  /// thousandth of their extent are interpolated there. Throws Error for none.
  explicit Tetrahedra(std::span<const vec3> points);

  /// Weights at p: not negative, with a sum of 1, continuous in p, and exact for linear fields inside of the
  /// hull. Outside of it they are those of the hull's point nearest to p: continuous as well, and never an
  /// extrapolation that overshoots (Cupisz extrudes the hull's triangles along normals instead, which needs
  /// a cubic equation and meets the same triangle for most points).
  CornerWeights at(const vec3& p) const;

  const std::vector<geometry::Tetrahedron>& cells() const { return cells_; }
  std::size_t hull_size() const { return hull_.triangles().size(); }
  std::size_t bytes() const;

 private:
  using Place = glm::dvec3;  ///< in lattice units

  Place place_of(const vec3& p) const;
  void make_frame(std::span<const vec3> points);
  void build_volume();
  void build_plane();
  void build_line();
  void drop_flat_cells();
  void set_hull(const std::vector<std::array<std::int32_t, 3>>& triangles);
  void set_starts();
  /// The cell that holds p, or −1; sets the weights of its corners.
  std::int32_t walk(const Place& p, std::int32_t from, std::array<double, 4>& weight) const;
  CornerWeights on_hull(const Place& p) const;

  int dimension_ = 3;
  glm::dvec3 origin_{0};
  glm::dmat3 frame_{1};  ///< world to lattice units
  std::vector<geometry::LatticePoint> points_;
  std::vector<std::int32_t> index_;  ///< of each lattice point among those given
  std::vector<geometry::Tetrahedron> cells_;
  geometry::TriangleTree hull_;
  std::vector<std::array<std::int32_t, 3>> hull_corners_;
  std::vector<std::int32_t> starts_;  ///< a cell near the middle of each box of a coarse grid
  glm::ivec3 start_size_{1};
  glm::dvec3 start_low_{0}, start_step_{1};
};

}  // namespace ssphh::methods::probe_volume
