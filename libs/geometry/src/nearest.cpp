#include <algorithm>

#include <ssphh/core/require.h>
#include <ssphh/geometry/nearest.h>

#include "median_split.h"

namespace ssphh::geometry {
namespace {
constexpr std::size_t leaf = 8;  // points that are not split any further
}

/// A sorted list of the best so far.
struct NearestPoints::Search {
  vec3 x;
  std::span<Near> out;
  int count = 0;
  float limit2;  ///< squared distance beyond which nothing is wanted

  void offer(const Near& candidate) {
    const auto wanted = static_cast<int>(out.size());
    if (count == wanted && !(candidate < out[count - 1])) return;
    int at = count < wanted ? count++ : wanted - 1;
    for (; at > 0 && candidate < out[at - 1]; --at) out[at] = out[at - 1];
    out[at] = candidate;
    if (count == wanted) limit2 = std::min(limit2, out[count - 1].distance2);
  }
  void look_at(const Item& item) {
    const vec3 d = item.position - x;
    const float d2 = glm::dot(d, d);
    if (d2 <= limit2) offer({d2, item.index});
  }
};

NearestPoints::NearestPoints(std::span<const vec3> points) : axis_(points.size()) {
  require(std::ranges::all_of(points, is_finite), "nearest points", "a point is not finite");
  for (std::size_t i = 0; i < points.size(); ++i) items_.push_back({points[i], static_cast<int>(i)});
  sort(0, items_.size());
}

void NearestPoints::sort(std::size_t begin, std::size_t end) {
  if (end - begin <= leaf) return;
  const std::size_t middle = begin + (end - begin) / 2;
  axis_[middle] = static_cast<std::uint8_t>(split_at_median(
      std::span(items_).subspan(begin, end - begin), [](const Item& item) { return item.position; },
      [](const Item& item) { return item.index; }));
  sort(begin, middle);
  sort(middle + 1, end);
}

void NearestPoints::visit(std::size_t begin, std::size_t end, Search& search) const {
  if (end - begin <= leaf) {
    for (std::size_t i = begin; i < end; ++i) search.look_at(items_[i]);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  search.look_at(items_[middle]);
  const float side = search.x[axis_[middle]] - items_[middle].position[axis_[middle]];
  const bool low_first = side < 0;
  low_first ? visit(begin, middle, search) : visit(middle + 1, end, search);
  if (side * side <= search.limit2) low_first ? visit(middle + 1, end, search) : visit(begin, middle, search);
}

int NearestPoints::find(const vec3& x, std::span<Near> out, float radius) const {
  if (out.empty()) return 0;
  Search search{x, out, 0, radius * radius};
  visit(0, items_.size(), search);
  return search.count;
}

}  // namespace ssphh::geometry
