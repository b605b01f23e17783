#pragma once
/// Points by cubic cells, to find those near a place.

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/core/random.h>

namespace ssphh::geometry {

class NearGrid {
 public:
  /// `radius`: the largest that near() is asked for, metres.
  explicit NearGrid(float radius) : radius_(radius) {}

  void add(const vec3& p) {
    cells_[key(cell(p))].push_back(static_cast<std::uint32_t>(points_.size()));
    points_.push_back(p);
  }
  std::size_t size() const { return points_.size(); }

  /// Indices, in order of add(), of the points nearer than `radius` (at most the grid's own).
  std::vector<std::uint32_t> near(const vec3& p, float radius) const {
    std::vector<std::uint32_t> found;
    const glm::ivec3 c = cell(p);
    for (const int z : {-1, 0, 1}) {
      for (const int y : {-1, 0, 1}) {
        for (const int x : {-1, 0, 1}) {
          const auto at = cells_.find(key(c + glm::ivec3(x, y, z)));
          if (at == cells_.end()) continue;
          for (const std::uint32_t i : at->second) {
            if (glm::distance(points_[i], p) < radius) found.push_back(i);
          }
        }
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  glm::ivec3 cell(const vec3& p) const { return {glm::floor(p / radius_)}; }
  /// Cells that share a key only cost time.
  static std::uint64_t key(const glm::ivec3& c) {
    return hash_combine(hash_combine(static_cast<std::uint32_t>(c.x), static_cast<std::uint32_t>(c.y)),
                        static_cast<std::uint32_t>(c.z));
  }

  float radius_;
  std::vector<vec3> points_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace ssphh::geometry
