#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <ssphh/study/lookup_error.h>

#include "truth_luminance.h"

namespace ssphh::study {
namespace {

using glm::dvec3;

/// One quantity at all points.
struct Quantity {
  std::vector<double> looked_up, truth, deviation;

  double mean_truth() const {
    double sum = 0;
    for (const double t : truth) sum += t;
    return truth.empty() ? 0 : sum / static_cast<double>(truth.size());
  }
};

/// The smallest value that a share of them does not exceed; sorts them.
double rank(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1];
}

double without_noise(double mean, double noise) {
  return std::sqrt(std::max(0.0, mean * mean - noise * noise));
}

/// Mean of |x| for a normal x of deviation 1.
const double mean_of_normal = std::sqrt(2 / pi_d);

RelativeError relative_error(const Quantity& q, double floor) {
  RelativeError error;
  error.mean_truth = q.mean_truth();
  error.ratio = std::numeric_limits<double>::quiet_NaN();
  if (!(floor > 0)) return error;
  const auto count = static_cast<double>(q.truth.size());
  double sum = 0;
  std::vector<double> relative;
  for (std::size_t i = 0; i < q.truth.size(); ++i) {
    const double d = q.looked_up[i] - q.truth[i], deviation = q.deviation[i], by = q.truth[i] + floor;
    sum += q.looked_up[i];
    relative.push_back(std::abs(d) / by);
    error.mean_relative += relative.back() / count;
    error.noise += mean_of_normal * deviation / by / count;
    error.relmse += (d * d - deviation * deviation) / (by * by) / count;
  }
  if (error.mean_truth > 0) error.ratio = sum / (count * error.mean_truth);
  error.mean_error = without_noise(error.mean_relative, error.noise);
  error.median_relative = rank(relative, 0.5);
  error.p95_relative = rank(relative, 0.95);
  return error;
}

/// Σ over the channels of the standard deviations of t / Σt. With c = t / Σt, dc_k = (dt_k − c_k Σ dt) / Σt.
double chromaticity_deviation(const rays::IrradianceEstimate& truth, const dvec3& c, double sum) {
  const dvec3 variance(truth.indirect_variance), beside(truth.indirect_covariance);
  // Covariance of each channel with the sum of all three.
  const dvec3 with_sum = variance + beside + dvec3(beside.z, beside.x, beside.y);
  const double of_sum = with_sum.x + with_sum.y + with_sum.z;
  double deviation = 0;
  for (int k = 0; k < 3; ++k)
    deviation += std::sqrt(std::max(0.0, variance[k] - 2 * c[k] * with_sum[k] + c[k] * c[k] * of_sum)) / sum;
  return deviation;
}

ChromaticityError chromaticity_error(std::span<const vec3> looked_up,
                                     std::span<const rays::IrradianceEstimate> truth, double floor) {
  ChromaticityError error;
  if (!(floor > 0)) return error;
  const auto total = [](const dvec3& rgb) { return rgb.x + rgb.y + rgb.z; };
  std::vector<double> differences;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const dvec3 t(truth[i].indirect), e = glm::max(dvec3(looked_up[i]), dvec3(0));
    differences.push_back(0);
    if (!(total(t) > 0)) continue;
    const dvec3 c = t / total(t), found = total(e) > 0 ? e / total(e) : dvec3(1.0 / 3);
    const double weight = total(t) / (total(t) + 3 * floor);
    differences.back() = weight * total(glm::abs(found - c));
    error.mean += differences.back();
    error.noise += mean_of_normal * weight * chromaticity_deviation(truth[i], c, total(t));
  }
  error.mean /= static_cast<double>(truth.size()), error.noise /= static_cast<double>(truth.size());
  error.p95 = rank(differences, 0.95);
  error.mean_error = without_noise(error.mean, error.noise);
  return error;
}

}  // namespace

LookupError lookup_error(std::span<const vec3> looked_up, std::span<const rays::IrradianceEstimate> truth) {
  require(looked_up.size() == truth.size(), "lookup error", "there is not one lookup for each truth");
  std::array<Quantity, 3> rgb;
  Quantity grey;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const vec3 deviation = glm::sqrt(glm::max(truth[i].indirect_variance, vec3(0)));
    for (int c = 0; c < 3; ++c) {
      Quantity& q = rgb[c];
      q.looked_up.push_back(static_cast<double>(looked_up[i][c]));
      q.truth.push_back(static_cast<double>(truth[i].indirect[c]));
      q.deviation.push_back(static_cast<double>(deviation[c]));
    }
    grey.looked_up.push_back(static_cast<double>(luminance(looked_up[i])));
    grey.truth.push_back(true_luminance(truth[i]));
    grey.deviation.push_back(true_deviation(truth[i]));
  }
  const double floor = relative_floor * (rgb[0].mean_truth() + rgb[1].mean_truth() + rgb[2].mean_truth()) / 3;
  LookupError error;
  error.points = truth.size();
  for (std::size_t c = 0; c < 3; ++c) error.channels[c] = relative_error(rgb[c], floor);
  error.luminance = relative_error(grey, relative_floor * grey.mean_truth());
  error.chromaticity = chromaticity_error(looked_up, truth, floor);
  return error;
}

RelativeError worst_channel(const LookupError& error) {
  RelativeError worst;
  worst.ratio = std::numeric_limits<double>::quiet_NaN();
  worst.relmse = -std::numeric_limits<double>::infinity();
  for (const RelativeError& channel : error.channels) {
    if (!std::isnan(channel.ratio) && !(std::abs(channel.ratio - 1) <= std::abs(worst.ratio - 1)))
      worst.ratio = channel.ratio;
    for (double RelativeError::*figure :
         {&RelativeError::mean_truth, &RelativeError::mean_relative, &RelativeError::median_relative,
          &RelativeError::p95_relative, &RelativeError::noise, &RelativeError::mean_error,
          &RelativeError::relmse})
      worst.*figure = std::max(worst.*figure, channel.*figure);
  }
  return worst;
}

}  // namespace ssphh::study
