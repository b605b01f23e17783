#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/gi/leak.h>

#include "truth_luminance.h"

namespace ssphh::gi {
namespace {

void check(std::span<const scene::SurfacePoint> points, const LeakParams& params) {
  if (points.empty()) throw Error("leak", "there are no points to measure at");
  if (!(params.dark_share > 0 && params.dark_share < 1))
    throw Error("leak",
                fmt::format("the share of darkness must lie between 0 and 1, not {:g}", params.dark_share));
  if (!(params.sigmas >= 0) || !std::isfinite(params.sigmas))
    throw Error("leak", fmt::format("{:g} standard deviations are none", params.sigmas));
  if (!(params.mean >= 0) || !std::isfinite(params.mean))
    throw Error("leak", fmt::format("a mean irradiance of {:g} is none", params.mean));
}

}  // namespace

LeakReport measure_leak(const scene::RadianceSource& source, const scene::IndirectLight& lookup,
                        std::span<const scene::SurfacePoint> points, const LeakParams& params,
                        const Control& control) {
  check(points, params);
  LeakReport report;
  report.looked_up.resize(points.size());
  parallel_for(
      points.size(), 64,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          report.looked_up[i] = luminance(lookup.irradiance(points[i].position, points[i].normal));
      },
      control);

  const std::vector<scene::IrradianceEstimate> truth =
      source.surface_irradiance(points, params.path, control);
  double truth_sum = 0, deviations = 0, looked_up_sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    report.truth.push_back(static_cast<float>(true_luminance(truth[i])));
    truth_sum += true_luminance(truth[i]);
    deviations += true_deviation(truth[i]);
    looked_up_sum += static_cast<double>(report.looked_up[i]);
  }
  const auto count = static_cast<double>(points.size());
  report.mean_truth = truth_sum / count;
  report.mean_looked_up = looked_up_sum / count;
  report.truth_noise = truth_sum > 0 ? deviations / truth_sum : 0;

  const double mean = params.mean > 0 ? static_cast<double>(params.mean) : report.mean_truth;
  const double limit = static_cast<double>(params.dark_share) * mean;
  const auto is_dark = [&](const scene::IrradianceEstimate& estimate) {
    return true_luminance(estimate) + static_cast<double>(params.sigmas) * true_deviation(estimate) <= limit;
  };
  std::vector<scene::SurfacePoint> suspects;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_dark(truth[i])) continue;
    suspects.push_back(points[i]);
    of.push_back(i);
  }
  report.dark_at.assign(points.size(), 0);
  double leaked = 0;
  if (!suspects.empty()) {
    scene::PathParams again = params.path;
    again.spp *= 4;
    again.seed = mix64(again.seed);
    const auto second = source.surface_irradiance(suspects, again, control);
    for (std::size_t s = 0; s < suspects.size(); ++s) {
      if (!is_dark(second[s])) continue;
      report.dark_at[of[s]] = 1;
      ++report.dark;
      leaked += static_cast<double>(report.looked_up[of[s]]);
    }
  }
  report.ratio = looked_up_sum > 0 ? leaked / looked_up_sum : 0;
  return report;
}

}  // namespace ssphh::gi
