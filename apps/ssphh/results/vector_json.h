#pragma once

#include <ssphh/core/json.h>
#include <ssphh/core/math.h>

namespace ssphh::app {

/// [x, y, z]
template <class T>
json::Value to_json(const glm::vec<3, T>& v) {
  return {v.x, v.y, v.z};
}

}  // namespace ssphh::app
