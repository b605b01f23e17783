#pragma once
/// How far looked-up indirect irradiance is from path tracing, channel by channel and in its colour.

#include <array>
#include <span>

#include <ssphh/rays/radiance_source.h>

namespace ssphh::study {

/// Errors of one quantity, over points with looked-up irradiance e, truth t and the truth's variance v; ε
/// keeps dark points from deciding.
struct RelativeError {
  double mean_truth = 0;     ///< [W/m²]
  double ratio = 0;          ///< Σ e / Σ t; NaN where the truth is dark everywhere
  double mean_relative = 0;  ///< mean of |e − t| / (t + ε); holds the truth's own noise
  double median_relative = 0, p95_relative = 0;  ///< of the same: half and 95 % of the points are better
  double noise = 0;  ///< what mean_relative would be for e without error: √(2/π) mean of √v / (t + ε)
  double mean_error = 0;  ///< √(mean_relative² − noise²), at least 0: mean_relative without the truth's
                          ///< noise, exact where both are normal
  double relmse = 0;  ///< mean of ((e − t)² − v) / (t + ε)²: the noise is subtracted; may come out below 0
};

/// Errors of chromaticity c = rgb / (r + g + b), whatever the brightness: d = w Σ |c(e) − c(t)| over the
/// channels with w = Σt / (Σt + 3ε); about 0 for the same colour and 2 for red instead of blue. Where nothing
/// was looked up, c(e) is grey.
struct ChromaticityError {
  double mean = 0;  ///< of d; holds the truth's own noise
  double p95 = 0;   ///< of d: 95 % of the points are better
  double noise = 0;  ///< what `mean` would be for c(e) without error: √(2/π) mean of w Σ √variance of c(t),
                     ///< to first order from the truth's variances and covariances
  double mean_error = 0;  ///< √(mean² − noise²), at least 0
};

struct LookupError {
  std::size_t points = 0;
  /// Red, green and blue; ε = relative_floor · the mean truth of all three, so that a channel with hardly any
  /// light is held against what is seen beside it.
  std::array<RelativeError, 3> channels;
  RelativeError luminance;         ///< Rec.709; ε = relative_floor · its own mean truth
  ChromaticityError chromaticity;  ///< ε as of the channels
};
inline constexpr double relative_floor = 0.01;

/// Both spans are of one size. Errors are 0 where all is dark.
LookupError lookup_error(std::span<const vec3> looked_up, std::span<const rays::IrradianceEstimate> truth);

/// Each figure of the channel that is worst in it: the ratio farthest from 1 (NaN where all are dark), the
/// largest of the others. Where one number must stand for a colour.
RelativeError worst_channel(const LookupError& error);

}  // namespace ssphh::study
