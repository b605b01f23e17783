#pragma once

#include <random>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::test {

/// The same at every call: uniform within ±`extent` along each axis.
inline std::vector<vec3> random_points(std::size_t count, float extent) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-extent, extent);
  std::vector<vec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  return points;
}

}  // namespace ssphh::test
