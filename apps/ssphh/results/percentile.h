#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace ssphh::app {

/// The smallest of the values that a share of them (0..1) does not exceed; 0 without values.
inline double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

}  // namespace ssphh::app
