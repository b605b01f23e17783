#pragma once
/// Nearest neighbours among fixed points.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::geometry {

struct Near {
  float distance2;
  int index;
  friend bool operator<(const Near& a, const Near& b) {
    return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.index < b.index);
  }
};

/// A k-d tree (Bentley 1975) in the order of its points: the middle of a range splits it, down to a few
/// points.
class NearestPoints {
 public:
  /// Throws Error for a point that is not finite.
  explicit NearestPoints(std::span<const vec3> points);

  /// The out.size() nearest points within `radius`, by distance, ties by index; returns how many there are.
  int find(const vec3& x, std::span<Near> out, float radius = std::numeric_limits<float>::infinity()) const;
  std::size_t bytes() const { return items_.size() * (sizeof(Item) + 1); }

 private:
  struct Item {
    vec3 position;
    int index;
  };
  struct Search;
  void sort(std::size_t begin, std::size_t end);
  void visit(std::size_t begin, std::size_t end, Search& search) const;

  std::vector<Item> items_;
  std::vector<std::uint8_t> axis_;  ///< of the split at each middle
};

}  // namespace ssphh::geometry
