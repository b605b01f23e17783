#pragma once
/// Boxes against segments, rays, and all segments from a point to a box.

#include <algorithm>

#include <ssphh/scene/query.h>

namespace ssphh::trace {

/// Whether some p + t d with d in the box `directions` and 0 ≤ t ≤ t_max lies in `box`. Exact but for
/// rounding: at each t the points form a box themselves.
inline bool sweep_meets(const vec3& p, const scene::Bounds& directions, float t_max,
                        const scene::Bounds& box) {
  if (box.empty() || directions.empty()) return false;
  float first = 0, last = t_max;
  // Cuts [first, last] down to t a ≤ c.
  const auto cut = [&](float a, float c) {
    if (a > 0) {
      last = std::min(last, c / a);
    } else if (a < 0) {
      first = std::max(first, c / a);
    } else if (c < 0) {
      last = -1;
    }
  };
  for (int k = 0; k < 3; ++k) {
    cut(directions.min[k], box.max[k] - p[k]);
    cut(-directions.max[k], p[k] - box.min[k]);
  }
  return first <= last;
}

inline scene::Bounds grown(const scene::Bounds& box, float by) {
  return box.empty() ? box : scene::Bounds{box.min - by, box.max + by};
}

}  // namespace ssphh::trace
