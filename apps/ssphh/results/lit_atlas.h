#pragma once
/// A lightmap of a probe set's light.

#include <ssphh/lightmap/light.h>
#include <ssphh/pipeline/surface_light.h>

namespace ssphh::app {

/// `factor` · irradiance [W/m²] in each texel: what the lookup holds, and with `direct_samples` over 0 light
/// straight from emitters, by about so many samples of each with an extent, spread over the texel.
image::Image lit_atlas(const pipeline::SurfaceLight& light, const lightmap::Texels& texels,
                       const lightmap::Places& places, int direct_samples, float factor,
                       const Control& control);

}  // namespace ssphh::app
