#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include <ssphh/core/math.h>

namespace ssphh::geometry {

/// Sorts items in two halves along the axis on which their places lie farthest apart, and returns that axis:
/// none of the first half stands after one of the second, which begins at `items.size() / 2`. `place_of` and
/// `number_of` tell of an item where it is, and a number of its own that decides where places are the same.
template <class Item, class PlaceOf, class NumberOf>
int split_at_median(std::span<Item> items, const PlaceOf& place_of, const NumberOf& number_of) {
  vec3 low = place_of(items.front()), high = low;
  for (const Item& item : items) {
    low = glm::min(low, place_of(item));
    high = glm::max(high, place_of(item));
  }
  const vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const auto key = [&](const Item& item) { return std::pair(place_of(item)[axis], number_of(item)); };
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2), items.end(),
                   [&](const Item& a, const Item& b) { return key(a) < key(b); });
  return axis;
}

}  // namespace ssphh::geometry
