#pragma once
/// How much a point on a surface counts at a place near it, factor by factor.

#include <algorithm>
#include <cmath>

#include <ssphh/core/vectors.h>
#include <ssphh/probes/lookup_constants.h>

namespace ssphh::probes {

/// At a squared distance [m²]: 0 from three of the point's spacings on, and most of a lookup's weight lies
/// within two. Of points far apart less, for they reach over finer ones: those of a plain over a street
/// [1/m].
inline float share_by_distance(float distance2, float spacing) {
  float t = std::max(1 - distance2 / (fitted_reach * fitted_reach * spacing * spacing), 0.0f);
  for (int i = 0; i < 3; ++i) t *= t;
  return t / spacing;
}

/// On a surface: less as that turns away from the point, or the point lies off its plane; 0 from 45° on, and
/// from half a spacing and a tenth of the distance. `off_plane` is the part of the offset along the normal.
inline float share_by_surface(float distance, float off_plane, float cosine, float spacing) {
  const float facing = (cosine - fitted_cosine) / (1 - fitted_cosine);
  const float off = off_plane / (fitted_off_plane * spacing + fitted_off_plane_slope * distance);
  const float level = 1 - off * off;
  return (facing > 0) & (level > 0) ? facing * level * level : 0;
}

/// What a point keeps of its weight at this distance where something stands that near before it.
inline float cover_factor(int cover, float distance2, float spacing) {
  const float open = spacing / static_cast<float>(1 << cover), q = distance2 / (open * open);
  return cover == 0 ? 1 : 1 / (1 + q * q);
}

/// What it keeps where those that count stand nearer to each other, `mean` metres: a far one of a plain, with
/// its long lever, would tilt the fit of a room.
inline float share_beside_finer(float distance2, float mean) {
  const float q = distance2 / (fitted_coarser * fitted_coarser * mean * mean);
  return 1 / (1 + q * q);
}

}  // namespace ssphh::probes
