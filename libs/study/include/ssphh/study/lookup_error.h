#pragma once
/// How far looked-up indirect irradiance is from path tracing.

#include <span>

#include <ssphh/rays/radiance_source.h>

namespace ssphh::study {

/// Over points i with looked-up irradiance e_i, truth t_i and the truth's variance v_i, all as Rec.709
/// luminance; ε = relative_floor · mean t keeps dark points from deciding.
struct LookupError {
  std::size_t points = 0;
  double mean_truth = 0;     ///< [W/m²]
  double ratio = 0;          ///< Σ e / Σ t; NaN where the truth is dark everywhere
  double mean_relative = 0;  ///< mean of |e − t| / (t + ε); holds the truth's own noise
  double median_relative = 0, p95_relative = 0;  ///< of the same: half and 95 % of the points are better
  double noise = 0;  ///< what mean_relative would be for e without error: √(2/π) mean of √v / (t + ε)
  double mean_error = 0;  ///< √(mean_relative² − noise²), at least 0: mean_relative without the truth's
                          ///< noise, exact where both are normal
  double relmse = 0;  ///< mean of ((e − t)² − v) / (t + ε)²: the noise is subtracted; may come out below 0
};
inline constexpr double relative_floor = 0.01;

/// Both spans are of one size. Relative errors are 0 where all is dark.
LookupError lookup_error(std::span<const vec3> looked_up, std::span<const rays::IrradianceEstimate> truth);

}  // namespace ssphh::study
