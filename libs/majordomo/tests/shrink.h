#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace ssphh::majordomo::test {

/// What is left of a failing sequence when all is taken out that it can fail without: halves first, single
/// steps last. `fails` tells of a sequence whether it fails.
template <class Step, class Fails>
std::vector<Step> shrunk(std::vector<Step> steps, const Fails& fails) {
  for (std::size_t length = steps.size(); length > 0; length /= 2)
    for (std::size_t at = 0; at + length <= steps.size();) {
      std::vector<Step> fewer = steps;
      const auto first = fewer.begin() + static_cast<std::ptrdiff_t>(at);
      fewer.erase(first, first + static_cast<std::ptrdiff_t>(length));
      if (fails(fewer)) {
        steps = std::move(fewer);
      } else {
        at += length;
      }
    }
  return steps;
}

}  // namespace ssphh::majordomo::test
