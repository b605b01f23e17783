#include <cmath>
#include <limits>

#include <ssphh/gi/lookup_error.h>

#include "truth_luminance.h"

namespace ssphh::gi {

LookupError lookup_error(std::span<const vec3> looked_up, std::span<const scene::IrradianceEstimate> truth) {
  SSPHH_CHECK(looked_up.size() == truth.size());
  LookupError error;
  error.points = truth.size();
  double truth_sum = 0, sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth_sum += true_luminance(truth[i]);
    sum += static_cast<double>(luminance(looked_up[i]));
  }
  const auto count = static_cast<double>(truth.size());
  if (!(truth_sum > 0)) {
    error.ratio = std::numeric_limits<double>::quiet_NaN();
    return error;
  }
  error.mean_truth = truth_sum / count;
  error.ratio = sum / truth_sum;
  const double floor = relative_floor * error.mean_truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double t = true_luminance(truth[i]), d = static_cast<double>(luminance(looked_up[i])) - t;
    const double deviation = true_deviation(truth[i]), by = t + floor;
    error.mean_relative += std::abs(d) / by / count;
    error.noise += std::sqrt(2 / pi_d) * deviation / by / count;
    error.relmse += (d * d - deviation * deviation) / (by * by) / count;
  }
  return error;
}

}  // namespace ssphh::gi
