#include "exposure_follower.h"

#include <algorithm>
#include <cmath>

namespace ssphh::viewer {

float ExposureFollower::follow(float suits) {
  constexpr float hold = 0.5f, share = 1.0f / 8, least = 1.0f / 16;
  if (!shown_) return take(suits);
  if (std::abs(suits - aim_) >= hold) aim_ = suits;
  const float way = aim_ - *shown_, step = std::max(share * std::abs(way), least);
  shown_ = std::abs(way) <= step ? aim_ : *shown_ + std::copysign(step, way);
  return *shown_;
}

float ExposureFollower::take(float suits) {
  aim_ = suits;
  shown_ = suits;
  return suits;
}

}  // namespace ssphh::viewer
