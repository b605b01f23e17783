#include "overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ssphh::lightmap {
namespace {

constexpr float tolerance = 1e-5f;

struct Range {
  vec2 low, high;
  explicit Range(const FlatCorners& t)
      : low(glm::min(t[0], glm::min(t[1], t[2]))), high(glm::max(t[0], glm::max(t[1], t[2]))) {}
  float extent() const { return std::max(high.x - low.x, high.y - low.y); }
};

/// Whether the line along an edge of `a` parts them.
bool parted(const FlatCorners& a, const FlatCorners& b, float slack) {
  for (std::size_t k = 0; k < 3; ++k) {
    const vec2 edge = a[(k + 1) % 3] - a[k];
    const float length = glm::length(edge);
    if (!(length > 0)) continue;
    const vec2 n = vec2(-edge.y, edge.x) / length;
    const float inner = glm::dot(n, a[(k + 2) % 3] - a[k]);
    const float side = inner < 0 ? -1.0f : 1.0f;
    float deepest = -std::numeric_limits<float>::infinity();
    for (const vec2& corner : b) deepest = std::max(deepest, side * glm::dot(n, corner - a[k]));
    if (deepest <= slack) return true;
  }
  return false;
}

}  // namespace

bool overlap(const FlatCorners& a, const FlatCorners& b) {
  const Range ra(a), rb(b);
  const float slack = tolerance * std::max(ra.extent(), rb.extent());
  if (glm::any(glm::lessThan(ra.high, rb.low)) || glm::any(glm::lessThan(rb.high, ra.low))) return false;
  return !parted(a, b, slack) && !parted(b, a, slack);
}

bool FlatTriangles::overlaps(const FlatCorners& triangle) const {
  const Range range(triangle);
  for (const auto& [exponent, level] : levels_) {
    const auto any = [&](const std::vector<std::uint32_t>& list) {
      for (const std::uint32_t other : list)
        if (overlap(triangle, triangles_[other])) return true;
      return false;
    };
    // A triangle reaches at most one cell beyond the one that holds its middle.
    const vec2 low = glm::floor(range.low / level.size) - 1.0f,
               high = glm::floor(range.high / level.size) + 1.0f;
    if ((high.x - low.x + 1) * (high.y - low.y + 1) > static_cast<float>(level.all.size())) {
      if (any(level.all)) return true;
      continue;
    }
    for (auto y = static_cast<std::int64_t>(low.y); y <= static_cast<std::int64_t>(high.y); ++y) {
      for (auto x = static_cast<std::int64_t>(low.x); x <= static_cast<std::int64_t>(high.x); ++x) {
        const auto found = level.cells.find({x, y});
        if (found != level.cells.end() && any(found->second)) return true;
      }
    }
  }
  return false;
}

bool FlatTriangles::add(const FlatCorners& triangle) {
  if (overlaps(triangle)) return false;
  const Range range(triangle);
  const int exponent = range.extent() > 0 ? std::ilogb(range.extent()) + 1 : 0;
  Level& level = levels_[exponent];
  level.size = std::ldexp(1.0f, exponent);
  const vec2 middle = glm::floor(0.5f * (range.low + range.high) / level.size);
  const auto index = static_cast<std::uint32_t>(triangles_.size());
  level.all.push_back(index);
  level.cells[{static_cast<std::int64_t>(middle.x), static_cast<std::int64_t>(middle.y)}].push_back(index);
  triangles_.push_back(triangle);
  return true;
}

}  // namespace ssphh::lightmap
