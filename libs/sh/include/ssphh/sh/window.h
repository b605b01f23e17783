#pragma once
/// Windowing: truncated series ring, and may become negative between lobes. A window damps the higher bands;
/// wider is milder. Band 0, the mean, is never changed.

#include <array>
#include <limits>

#include <ssphh/core/enum_names.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

/// One factor per band.
using BandScales = std::array<float, max_degree + 1>;

/// (1 + cos(π l/w)) / 2 for l < w, else 0 (Sloan, Stupid Spherical Harmonics Tricks, GDC 2008). w > 0 in
/// bands; infinity: no window.
BandScales hanning_window(double width);

/// Lanczos' σ factors sin(π l/w) / (π l/w) for l < w, else 0.
BandScales lanczos_window(double width);

/// Multiplies each band by its factor. A factor of exactly 1 leaves the bits as they are.
RadianceSh apply_window(const RadianceSh& sh, const BandScales& scales);
void window_in_place(RadianceSh& sh, const BandScales& scales);

/// Lowest value of each channel over the sphere, to about 1e-6 of the function's range: dense samples and a
/// descent from the lowest of them.
vec3 minimum(const RadianceSh& radiance);
vec3 minimum(const IrradianceSh& irradiance);

/// What must not be negative.
enum class NonNegative { irradiance, radiance };
constexpr auto enum_table(NonNegative) {
  using enum NonNegative;
  return std::to_array<EnumName<NonNegative>>({{irradiance, "irradiance"}, {radiance, "radiance"}});
}

struct AutoWindow {
  /// Width of the mildest Lanczos window that reaches the goal; infinity when none is needed.
  double width = std::numeric_limits<double>::infinity();
  /// False when even the mean of a channel is negative: no window can help, and width is 1 (mean only).
  bool reached = true;
};

/// Chooses one window for all channels, so that hues stay (after Sloan, Deringing Spherical Harmonics,
/// SIGGRAPH Asia 2017 Technical Briefs: search for the minimum over the sphere, then the mildest window that
/// lifts it to 0). A function that is nowhere negative keeps its bits.
AutoWindow choose_window(const RadianceSh& radiance, NonNegative goal = NonNegative::irradiance);

/// choose_window and apply_window.
RadianceSh dering(const RadianceSh& radiance, NonNegative goal = NonNegative::irradiance);

}  // namespace ssphh::sh
