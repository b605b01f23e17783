#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/geometry/balls.h>

#include "median_split.h"

namespace ssphh::geometry {

Balls::Balls(std::span<const vec3> centres, std::span<const float> radii)
    : boxes_(centres.size() / step + 1) {
  require(centres.size() == radii.size(), "balls", "there is not one radius for each centre");
  require(std::ranges::all_of(centres, is_finite), "balls", "a centre is not finite");
  require(std::ranges::all_of(radii, [](float r) { return r >= 0 && std::isfinite(r); }), "balls",
          "a radius is negative or not finite");
  for (std::size_t i = 0; i < centres.size(); ++i)
    items_.push_back({centres[i], radii[i] * radii[i], static_cast<std::uint32_t>(i)});
  sort(0, items_.size(), radii);
}

Balls::Box Balls::sort(std::size_t begin, std::size_t end, std::span<const float> radii) {
  Box box;
  if (end - begin <= leaf) {
    for (std::size_t i = begin; i < end; ++i) {
      const float radius = radii[items_[i].ball];
      box.low = glm::min(box.low, items_[i].centre - radius);
      box.high = glm::max(box.high, items_[i].centre + radius);
    }
    return box;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  split_at_median(
      std::span(items_).subspan(begin, end - begin), [](const Item& item) { return item.centre; },
      [](const Item& item) { return item.ball; });
  for (const Box& half : {sort(begin, middle, radii), sort(middle, end, radii)}) {
    box.low = glm::min(box.low, half.low);
    box.high = glm::max(box.high, half.high);
  }
  return boxes_[middle / step] = box;
}

std::size_t Balls::bytes() const {
  return items_.size() * sizeof(Item) + boxes_.size() * sizeof(Box);
}

}  // namespace ssphh::geometry
