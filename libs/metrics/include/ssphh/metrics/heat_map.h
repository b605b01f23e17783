#pragma once
/// Colours for errors.

#include <ssphh/image/io.h>

namespace ssphh::metrics {

/// `inferno`: black over purple and yellow to white for 0..1, perceptually uniform (matplotlib; polynomial
/// fit by Matt Zucker, CC0). `diverging`: blue for −1, white for 0, red for 1 (Moreland, Diverging Color Maps
/// for Scientific Visualization, 2009). `grey`: black to white.
enum class ColorRamp { inferno, diverging, grey };

/// sRGB-encoded colour in [0, 1] of a value; outside values are clamped, NaN is magenta.
vec3 ramp_color(ColorRamp ramp, float value);

/// The pixels' channels averaged (of a map with colours) and coloured: `scale` maps to 1 (and −scale to −1
/// for `diverging`). A scale of 0 takes the 99th percentile of the magnitudes, so that few outliers do not
/// hide the rest.
image::Rgba8 heat_map(const image::Image& map, ColorRamp ramp, float scale = 0);

/// The scale that heat_map would take by itself; 1 for a map without any finite error.
float automatic_scale(const image::Image& map);

/// Every pixel repeated block×block times and cut to width×height: shows a pixelated map beside the image.
image::Image enlarge_blocks(const image::Image& pixelated, int block, int width, int height);

}  // namespace ssphh::metrics
