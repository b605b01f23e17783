#include "results/lit_atlas.h"

namespace ssphh::app {

image::Image lit_atlas(const pipeline::SurfaceLight& light, const lightmap::Texels& texels,
                       const lightmap::Places& places, int direct_samples, float factor,
                       const Control& control) {
  const auto held = [&](const rays::SurfacePoint& at) { return factor * light.held(at); };
  if (direct_samples == 0) return lightmap::light_texels(texels, places, held, nullptr, control);
  const int each = (direct_samples + lightmap::places_within - 1) / lightmap::places_within;
  return lightmap::light_texels(
      texels, places, held, [&](const rays::SurfacePoint& at) { return factor * light.direct(at, each); },
      control);
}

}  // namespace ssphh::app
