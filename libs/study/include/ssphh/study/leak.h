#pragma once
/// Light leaking: energy that a lookup puts where path tracing finds none.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::study {

struct LeakParams {
  /// A point is dark when its true indirect irradiance is less than this share of the mean …
  float dark_share = 1e-4f;
  float sigmas = 3;  ///< … even with so many standard deviations of the estimate on top.
  /// How the truth is traced. The points found dark are traced again, with four times the samples and other
  /// paths, and must stay dark: rare bright paths make light points look dark, and their variance with them.
  rays::PathParams path{.max_depth = rays::usual_max_depth, .passes = 1, .spp = 256, .seed = 0};
  double noise =
      0;           ///< that more paths are to bring the truth to, as converged_truth has it; 0: `path` alone
  float mean = 0;  ///< that dark_share refers to [W/m²]; 0: of the points, the brightest 5 % as the next one
};

/// All irradiances are indirect, as Rec.709 luminance [W/m²].
struct LeakReport {
  double ratio = 0;      ///< leak_ratio
  std::size_t dark = 0;  ///< points
  double mean_truth = 0, mean_looked_up = 0;
  double truth_noise = 0;             ///< Σ standard deviations of the truth / Σ truth: relative, per point
  std::vector<float> looked_up;       ///< at each point
  std::vector<float> truth;           ///< at each point
  std::vector<std::uint8_t> dark_at;  ///< 1 at dark points
};

/// Path-traced truth at points, and which of them are dark.
struct TruthAtPoints {
  std::vector<rays::IrradianceEstimate> estimates;
  std::vector<std::uint8_t> dark_at;  ///< 1 at dark points
  std::size_t dark = 0;
  int spp = 0;       ///< paths that each point got
  double mean = 0;   ///< indirect Rec.709 luminance [W/m²]
  double noise = 0;  ///< Σ standard deviations / Σ truth
};

/// Path traces each point. Throws Error without points and for parameters out of range.
TruthAtPoints trace_truth(const rays::RadianceSource& source, std::span<const rays::SurfacePoint> points,
                          const LeakParams& params = {}, const Control& control = {});

/// Indirect irradiance of each point.
std::vector<vec3> look_up(const rays::IndirectLight& lookup, std::span<const rays::SurfacePoint> points,
                          const Control& control = {});

/// Σ looked up at dark points / Σ looked up at all points; 0 where both are 0.
double leak_ratio(std::span<const vec3> looked_up, const TruthAtPoints& truth);

/// Looks up and path traces each point. Where points are uniform by area (surface_points.h), the ratio is one
/// of energies. Throws Error without points and for parameters out of range.
LeakReport measure_leak(const rays::RadianceSource& source, const rays::IndirectLight& lookup,
                        std::span<const rays::SurfacePoint> points, const LeakParams& params = {},
                        const Control& control = {});

}  // namespace ssphh::study
