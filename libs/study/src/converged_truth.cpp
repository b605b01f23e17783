#include <algorithm>
#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/require.h>
#include <ssphh/study/converged_truth.h>
#include <ssphh/study/lookup_error.h>

namespace ssphh::study {
namespace {

double noise_of(std::span<const rays::IrradianceEstimate> truth) {
  const std::vector<vec3> nothing(truth.size(),
                                  vec3(0));  // the noise is the same whatever is held against it
  return worst_channel(lookup_error(nothing, truth)).noise;
}

/// Of all points' light together, worst channel: its standard error as a share. Where next to nothing arrives
/// but at one or two points, the mean over all would call these exact.
double noise_of_sum(std::span<const rays::IrradianceEstimate> truth) {
  double worst = 0;
  for (glm::length_t c = 0; c < 3; ++c) {
    double sum = 0, variance = 0;
    for (const rays::IrradianceEstimate& estimate : truth) {
      sum += double{estimate.indirect[c]};
      variance += double{estimate.indirect_variance[c]};
    }
    if (sum > 0) worst = std::max(worst, std::sqrt(variance) / sum);
  }
  return worst;
}

/// Of two independent estimates with as many paths each, the mean.
void take_in(rays::IrradianceEstimate& estimate, const rays::IrradianceEstimate& other) {
  estimate.direct = 0.5f * (estimate.direct + other.direct);
  estimate.indirect = 0.5f * (estimate.indirect + other.indirect);
  estimate.indirect_variance = 0.25f * (estimate.indirect_variance + other.indirect_variance);
  estimate.indirect_covariance = 0.25f * (estimate.indirect_covariance + other.indirect_covariance);
}

}  // namespace

ConvergedTruth converged_truth(const rays::RadianceSource& source, std::span<const rays::SurfacePoint> points,
                               const rays::PathParams& path, double noise, const Control& control) {
  const auto trace = [&](const rays::PathParams& round) {
    auto estimates = source.surface_irradiance(points, round, control);
    require(estimates.size() == points.size(), "radiance source",
            "it answers with not one estimate for each point");
    return estimates;
  };
  ConvergedTruth truth{trace(path), path.passes * path.spp};
  const auto more_fit = [&] {
    return truth.spp <= most_truth_spp / 2 &&
           2 * static_cast<std::size_t>(truth.spp) * points.size() <= most_truth_paths;
  };
  rays::PathParams round = path;
  round.passes = 1;
  const auto noisy = [&] {
    return noise_of(truth.estimates) > noise || noise_of_sum(truth.estimates) > noise / 3;
  };
  while (noise > 0 && more_fit() && noisy()) {
    round.spp = truth.spp;
    round.seed = mix64(round.seed);
    const std::vector<rays::IrradianceEstimate> others = trace(round);
    for (std::size_t i = 0; i < others.size(); ++i) take_in(truth.estimates[i], others[i]);
    truth.spp *= 2;
  }
  return truth;
}

}  // namespace ssphh::study
