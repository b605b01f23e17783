#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/study/converged_truth.h>
#include <ssphh/study/leak.h>

#include "truth_luminance.h"

namespace ssphh::study {
namespace {

void check(std::span<const rays::SurfacePoint> points, const LeakParams& params) {
  if (points.empty()) throw Error("leak", "there are no points to measure at");
  if (!(params.dark_share > 0 && params.dark_share < 1))
    throw Error("leak",
                fmt::format("the share of darkness must lie between 0 and 1, not {:g}", params.dark_share));
  if (!(params.sigmas >= 0) || !std::isfinite(params.sigmas))
    throw Error("leak", fmt::format("{:g} standard deviations are none", params.sigmas));
  if (!(params.mean >= 0) || !std::isfinite(params.mean))
    throw Error("leak", fmt::format("a mean irradiance of {:g} is none", params.mean));
}

/// The mean with no value counted more than that which a twentieth of them exceeds: one lucky path, of the
/// sun's image in a pane, outshines all others.
double usual_mean(std::span<const rays::IrradianceEstimate> estimates) {
  std::vector<double> values;
  for (const rays::IrradianceEstimate& estimate : estimates) values.push_back(true_luminance(estimate));
  std::vector<double> sorted = values;
  const auto most = sorted.end() - 1 - static_cast<std::ptrdiff_t>(sorted.size() / 20);
  std::ranges::nth_element(sorted, most);
  double sum = 0;
  for (const double value : values) sum += std::min(value, *most);
  return sum / static_cast<double>(values.size());
}

}  // namespace

TruthAtPoints trace_truth(const rays::RadianceSource& source, std::span<const rays::SurfacePoint> points,
                          const LeakParams& params, const Control& control) {
  check(points, params);
  TruthAtPoints truth;
  ConvergedTruth traced = converged_truth(source, points, params.path, params.noise, control);
  truth.estimates = std::move(traced.estimates);
  truth.spp = traced.spp;
  double sum = 0, deviations = 0;
  for (const rays::IrradianceEstimate& estimate : truth.estimates) {
    sum += true_luminance(estimate);
    deviations += true_deviation(estimate);
  }
  truth.mean = sum / static_cast<double>(points.size());
  truth.noise = sum > 0 ? deviations / sum : 0;

  // What looks dark gets a second look.
  const double mean = params.mean > 0 ? static_cast<double>(params.mean) : usual_mean(truth.estimates);
  const double limit = static_cast<double>(params.dark_share) * mean;
  const auto is_dark = [&](const rays::IrradianceEstimate& estimate) {
    return true_luminance(estimate) + static_cast<double>(params.sigmas) * true_deviation(estimate) <= limit;
  };
  std::vector<rays::SurfacePoint> suspects;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_dark(truth.estimates[i])) continue;
    suspects.push_back(points[i]);
    of.push_back(i);
  }
  truth.dark_at.assign(points.size(), 0);
  if (suspects.empty()) return truth;
  rays::PathParams again = params.path;
  again.spp *= 4;
  again.seed = mix64(again.seed);
  const auto second = converged_truth(source, suspects, again, 0, control).estimates;
  for (std::size_t s = 0; s < suspects.size(); ++s) {
    if (!is_dark(second[s])) continue;
    truth.dark_at[of[s]] = 1;
    ++truth.dark;
  }
  return truth;
}

std::vector<vec3> look_up(const rays::IndirectLight& lookup, std::span<const rays::SurfacePoint> points,
                          const Control& control) {
  std::vector<vec3> looked_up(points.size());
  parallel_for(
      points.size(), 64, [&](std::size_t i) { looked_up[i] = lookup.irradiance(points[i]); }, control);
  return looked_up;
}

double leak_ratio(std::span<const vec3> looked_up, const TruthAtPoints& truth) {
  require(looked_up.size() == truth.dark_at.size(), "leak", "there is not one lookup for each point");
  double all = 0, leaked = 0;
  for (std::size_t i = 0; i < looked_up.size(); ++i) {
    const auto value = static_cast<double>(luminance(looked_up[i]));
    all += value;
    if (truth.dark_at[i]) leaked += value;
  }
  return all > 0 ? leaked / all : 0;
}

LeakReport measure_leak(const rays::RadianceSource& source, const rays::IndirectLight& lookup,
                        std::span<const rays::SurfacePoint> points, const LeakParams& params,
                        const Control& control) {
  const TruthAtPoints truth = trace_truth(source, points, params, control);
  const std::vector<vec3> looked_up = look_up(lookup, points, control);
  LeakReport report;
  report.ratio = leak_ratio(looked_up, truth);
  report.dark = truth.dark;
  report.dark_at = truth.dark_at;
  report.mean_truth = truth.mean;
  report.truth_noise = truth.noise;
  for (std::size_t i = 0; i < points.size(); ++i) {
    report.looked_up.push_back(luminance(looked_up[i]));
    report.truth.push_back(static_cast<float>(true_luminance(truth.estimates[i])));
    report.mean_looked_up += static_cast<double>(report.looked_up[i]) / static_cast<double>(points.size());
  }
  return report;
}

}  // namespace ssphh::study
