#pragma once

#include <cmath>

#include <ssphh/core/json.h>
#include <ssphh/core/math.h>

namespace ssphh::app {

/// [x, y, z]
template <class T>
json::Value to_json(const glm::vec<3, T>& v) {
  return {v.x, v.y, v.z};
}

/// JSON knows no infinity: null stands for what is not finite.
inline json::Value finite_or_null(double x) {
  return std::isfinite(x) ? json::Value(x) : json::Value();
}

}  // namespace ssphh::app
