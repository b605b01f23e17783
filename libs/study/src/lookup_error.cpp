#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <ssphh/study/lookup_error.h>

#include "truth_luminance.h"

namespace ssphh::study {

LookupError lookup_error(std::span<const vec3> looked_up, std::span<const rays::IrradianceEstimate> truth) {
  require(looked_up.size() == truth.size(), "lookup error", "there is not one lookup for each truth");
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
  std::vector<double> relative;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double t = true_luminance(truth[i]), d = static_cast<double>(luminance(looked_up[i])) - t;
    const double deviation = true_deviation(truth[i]), by = t + floor;
    relative.push_back(std::abs(d) / by);
    error.mean_relative += relative.back() / count;
    error.noise += std::sqrt(2 / pi_d) * deviation / by / count;
    error.relmse += (d * d - deviation * deviation) / (by * by) / count;
  }
  error.mean_error =
      std::sqrt(std::max(0.0, error.mean_relative * error.mean_relative - error.noise * error.noise));
  std::sort(relative.begin(), relative.end());
  const auto rank = [&](double share) {
    return relative[static_cast<std::size_t>(std::ceil(share * count)) - 1];
  };
  error.median_relative = rank(0.5);
  error.p95_relative = rank(0.95);
  return error;
}

}  // namespace ssphh::study
