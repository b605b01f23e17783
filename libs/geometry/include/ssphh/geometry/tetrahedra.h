#pragma once
/// Barycentric interpolation among points in space (Cupisz, Light Probe Interpolation Using Tetrahedral
/// Tessellations, GDC 2012).

#include <array>
#include <span>
#include <vector>

#include <ssphh/geometry/delaunay.h>
#include <ssphh/geometry/triangle_tree.h>
#include <ssphh/scene/query.h>

namespace ssphh::geometry {

struct CornerWeight {
  std::int32_t point;  ///< index among the points given
  float weight;
};

/// Weights of four points at most; the first `count` entries hold.
struct CornerWeights {
  std::array<CornerWeight, 4> entries;
  int count = 0;

  void add(std::int32_t point, float weight) { entries[count++] = {point, weight}; }
  std::span<const CornerWeight> used() const& { return {entries.data(), static_cast<std::size_t>(count)}; }
  void used() const&& = delete;  // the list would be gone
};

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

  /// None where the points lie in a plane or on a line. Vertices are indices of lattice points; corners()
  /// says which of the points given these are.
  const std::vector<Tetrahedron>& cells() const { return cells_; }
  /// The corners of a cell, as indices among the points given.
  std::array<std::int32_t, 4> corners(const Tetrahedron& cell) const {
    std::array<std::int32_t, 4> points;
    for (std::size_t k = 0; k < 4; ++k) points[k] = index_[cell.vertex[k]];
    return points;
  }
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
  std::vector<LatticePoint> points_;
  std::vector<std::int32_t> index_;  ///< of each lattice point among those given
  std::vector<Tetrahedron> cells_;
  TriangleTree hull_;
  std::vector<std::array<std::int32_t, 3>> hull_corners_;
  std::vector<std::int32_t> starts_;  ///< a cell near the middle of each box of a coarse grid
  glm::ivec3 start_size_{1};
  glm::dvec3 start_low_{0}, start_step_{1};
};

}  // namespace ssphh::geometry
