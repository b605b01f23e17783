#pragma once
/// Images of the whole sphere around a point: equirectangular and angular map. In both, u runs right and v
/// down, each from 0 to 1 over the image. Directions point away from the centre, toward what is seen.
///
/// Equirectangular (three.js's convention): v = θ/π with θ the angle from +y; u = 0.5 + atan2(z, x)/2π. So
/// the image's centre looks along +x, u = 0.75 along +z, u = 0 and 1 along −x, u = 0.25 along −z; the top row
/// is +y.
///
/// Angular map (Debevec's old "light probe" images): the centre looks along −z, right is +x, up is +y; the
/// distance from the centre (1 at the edge's middle) is the angle from −z divided by π. Outside that disc
/// nothing is defined.

#include <optional>

#include <ssphh/core/math.h>
#include <ssphh/image/image.h>

namespace ssphh::image {

/// Unit direction of a place on an equirectangular image.
vec3 equirect_direction(float u, float v);

/// Place of a direction (any length but zero), u and v in [0, 1]; at the poles u is 0.5.
vec2 equirect_uv(const vec3& direction);

/// Exact solid angle [sr] of each pixel in row y; times width and summed over rows: 4π.
double equirect_solid_angle(int y, int width, int height);

/// Bilinear; wraps around in u and across the poles. Throws Error for an empty image.
vec3 sample_equirect(const Image& image, const vec3& direction);
/// The same at a place that equirect_uv() gave.
vec3 sample_equirect_at(const Image& image, const vec2& uv);

/// Unit direction of a place on an angular map; none outside the disc.
std::optional<vec3> angular_direction(float u, float v);

/// Place of a direction (any length but zero); straight back (+z) is put on the right edge.
vec2 angular_uv(const vec3& direction);

/// Exact solid angle [sr] of the part of pixel (x, y) inside the disc of a size×size map; they sum to 4π.
double angular_solid_angle(int x, int y, int size);

/// Bilinear among the pixels whose centres lie in the disc.
vec3 sample_angular(const Image& image, const vec3& direction);

}  // namespace ssphh::image
