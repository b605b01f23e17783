#pragma once
/// The probes around a surface point, and whether the point sees them.

#include <algorithm>
#include <cmath>

#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/lookup_constants.h>

namespace ssphh::probes {

class ProbeSight {
 public:
  ProbeSight(std::span<const vec3> positions, const WeightParams& params)
      : positions_(positions.begin(), positions.end()),
        nearest_(positions),
        spacing_(params.spacing > 0 ? params.spacing : median_spacing(positions)),
        offset_(params.normal_offset) {}

  using NearList = std::array<geometry::Near, max_weights>;

  std::size_t bytes() const { return positions_.size() * sizeof(vec3) + nearest_.bytes(); }
  float spacing() const { return spacing_; }
  const vec3& position(int probe) const { return positions_[probe]; }

  /// Of the angle between n and the way from x to the probe; 1 where it stands at x.
  float cosine(int probe, const vec3& x, const vec3& n) const {
    const vec3 d = position(probe) - x;
    const float length = glm::length(d);
    return length > 0 ? glm::dot(n, d) / length : 1;
  }

  int nearest(const vec3& x, std::span<geometry::Near> near,
              float radius = std::numeric_limits<float>::infinity()) const {
    return nearest_.find(x, near, radius);
  }

  bool sees(const geometry::Near& near, const rays::SurfacePoint& at, const SeesProbe& sees) const {
    return sees(at.position + lift(near, at) * at.normal, position(near.index));
  }

  /// Moves the visible ones of the first `count` to the front, at most `wanted`; returns their number.
  int visible_first(NearList& near, int count, int wanted, const rays::SurfacePoint& at,
                    const SeesProbe& sees) const {
    int visible = 0;
    for (int i = 0; i < count && visible < wanted; ++i) {
      const geometry::Near candidate = near[i];
      if (!this->sees(candidate, at, sees)) continue;
      // Those that they replace were all hidden.
      std::swap(near[visible++], near[i]);
    }
    return visible;
  }

 private:
  float lift(const geometry::Near& near, const rays::SurfacePoint& at) const {
    if (offset_ > 0) return offset_;
    const float distance = std::sqrt(near.distance2), usual = sight_lift * std::min(distance, spacing_);
    if (at.moves || cosine(near.index, at.position, at.normal) >= -sight_below) return usual;
    return std::min(usual,
                    sight_lift_below * distance + sight_rounding * max_component(glm::abs(at.position)));
  }

  std::vector<vec3> positions_;
  geometry::NearestPoints nearest_;
  float spacing_, offset_;
};

}  // namespace ssphh::probes
