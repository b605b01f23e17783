#include "spacing_search.h"

#include <algorithm>
#include <cmath>

namespace ssphh::place {

SpacingSearch::SpacingSearch(const vec3& extent, std::size_t low, std::size_t high, double most_places)
    : low_(low), high_(high) {
  // A bare floor has some thickness, too.
  const vec3 thick = glm::max(extent, vec3(0.01f * max_component(extent)));
  const double volume = double{thick.x} * double{thick.y} * double{thick.z};
  spacing_ = static_cast<float>(std::cbrt(volume / static_cast<double>(low)));
  finest_ = static_cast<float>(1.1 * std::cbrt(volume / most_places));
}

bool SpacingSearch::prefers(std::size_t count, std::size_t best) const {
  return best < low_ ? count > best : count >= low_ && count < best;
}

bool SpacingSearch::go_on(std::size_t count) {
  const bool enough = count >= low_;
  if (enough && count <= high_) return false;
  if (!enough && spacing_ <= finest_) return false;
  (enough ? fine_ : coarse_) = spacing_;
  if (fine_ > 0 && coarse_ > 0) {
    spacing_ = std::sqrt(fine_ * coarse_);
    return true;
  }
  const double ratio =
      std::cbrt(static_cast<double>(std::max<std::size_t>(count, 1)) / static_cast<double>(low_));
  spacing_ *= static_cast<float>(enough ? std::clamp(ratio, 1.1, 2.0) : std::clamp(ratio, 0.5, 0.9));
  spacing_ = std::max(spacing_, finest_);
  return true;
}

}  // namespace ssphh::place
