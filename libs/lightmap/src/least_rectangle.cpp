#include "least_rectangle.h"

#include <algorithm>
#include <limits>

#include "flat.h"

namespace ssphh::lightmap {
namespace {

/// Counter-clockwise (Andrew's monotone chain).
std::vector<vec2> convex_hull(std::vector<vec2> points) {
  std::ranges::sort(points,
                    [](const vec2& a, const vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = hull.size();
    for (const vec2& p : points) {
      while (hull.size() >= begin + 2 && !(cross(hull.back() - hull[hull.size() - 2], p - hull.back()) > 0))
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

struct Turned {
  vec2 along{1, 0};
  vec2 low{0}, high{0};

  vec2 turn(const vec2& p) const { return {glm::dot(p, along), cross(along, p)}; }
};

Turned turned(const std::vector<vec2>& hull, const vec2& along) {
  Turned out{along, vec2(std::numeric_limits<float>::infinity()),
             vec2(-std::numeric_limits<float>::infinity())};
  for (const vec2& p : hull) {
    const vec2 q = out.turn(p);
    out.low = glm::min(out.low, q), out.high = glm::max(out.high, q);
  }
  return out;
}

}  // namespace

void lay_along_axes(Chart& chart) {
  std::vector<vec2> points;
  for (const FlatTriangle& t : chart.triangles) points.insert(points.end(), t.at.begin(), t.at.end());
  const std::vector<vec2> hull = convex_hull(std::move(points));
  // A hull of very many edges turns little between them.
  constexpr std::size_t most_tried = 256;
  const std::size_t step = (hull.size() + most_tried - 1) / most_tried;
  Turned best;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < hull.size(); i += step) {
    const vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const float length = glm::length(edge);
    if (!(length > 0)) continue;
    const Turned now = turned(hull, edge / length);
    const vec2 size = now.high - now.low;
    if (size.x * size.y < least) least = size.x * size.y, best = now;
  }
  const vec2 size = best.high - best.low;
  const bool upright = size.y > size.x;
  for (FlatTriangle& t : chart.triangles) {
    for (vec2& at : t.at) {
      at = best.turn(at) - best.low;
      if (upright) at = {size.y - at.y, at.x};
    }
  }
  chart.size = upright ? vec2(size.y, size.x) : size;
}

}  // namespace ssphh::lightmap
