#pragma once
/// Rays into the probes' maps.

#include "rays.h"

namespace ssphh::methods::ddgi {

struct DdgiBlend {
  float hysteresis = 0.97f;  ///< share of the last frame's value that stays
  /// Relative change of a texel's irradiance above which only a quarter of the usual share stays, and above
  /// three times of which nothing does; 0: never.
  float change = 0;
  float gamma = 1;  ///< irradiance is averaged over frames as its 1/gamma-th power
};

/// Blends one frame's rays, as trace_probes gives them, into the maps of the active probes. Of probes marked
/// in `fresh` nothing stays; the marks are cleared.
void blend_rays(DdgiField& field, std::span<const ProbeRay> rays, std::span<const vec3> directions,
                const DdgiBlend& params, std::span<std::uint8_t> fresh);

}  // namespace ssphh::methods::ddgi
