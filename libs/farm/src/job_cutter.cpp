#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/farm/job_cutter.h>

namespace ssphh::farm {

std::size_t JobCutter::next(std::size_t left, std::size_t workers) const {
  require(seconds_ >= 0 && most_ > 0, "job cutter", "the time of a job must be a number, and units over 0");
  if (left == 0) return 0;
  // Until something is known, one unit: it may take a minute.
  const double wanted = per_unit_ > 0 ? seconds_ / per_unit_ : 1;
  const double share =
      static_cast<double>(left) / (2.0 * static_cast<double>(std::max<std::size_t>(1, workers)));
  const double units = std::clamp(std::min(wanted, std::ceil(share)), 1.0, static_cast<double>(most_));
  return std::min(left, static_cast<std::size_t>(units));
}

void JobCutter::learn(std::size_t units, double seconds) {
  if (units == 0 || !(seconds >= 0)) return;
  const double each = std::max(seconds / static_cast<double>(units), 1e-6);
  per_unit_ = per_unit_ > 0 ? 0.7 * per_unit_ + 0.3 * each : each;
}

}  // namespace ssphh::farm
