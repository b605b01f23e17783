#pragma once
/// A lobe's function, tabulated: a ray asks for it many times.

#include <span>
#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/sketch/sketch.h>

namespace ssphh::sketch {

/// Places on the faces of a cube, those of its edges on both faces: bilinear interpolation has no seams.
class LobeGrid {
 public:
  explicit LobeGrid(int degree);
  int degree() const { return degree_; }
  int nodes() const { return nodes_; }
  /// Σ_k values[k] Y_k at every place.
  std::vector<float> evaluate(std::span<const float> values) const;

 private:
  int degree_, nodes_;
  std::vector<float> basis_;  ///< [k][place]
};

class LobeTable {
 public:
  /// `values` are of the grid's degree or a lower one.
  LobeTable(const LobeGrid& grid, std::span<const float> values);
  /// `direction` of any length but 0.
  float at(const vec3& direction) const;
  /// Of its magnitude.
  float most() const { return most_; }

 private:
  int nodes_;
  std::vector<float> table_;
  float most_ = 0;
};

/// Of each lobe, on one grid. Throws Error for values that are not those of a degree up to 10.
std::vector<LobeTable> lobe_tables(std::span<const Lobe> lobes);

}  // namespace ssphh::sketch
