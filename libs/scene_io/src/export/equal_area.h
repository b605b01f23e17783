#pragma once
/// The equal-area map of the sphere to a square (Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using
/// SIMD, 2008), as pbrt-v4 uses it for environments.

#include <ssphh/image/image.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Unit direction of a place on the square, u and v in [0, 1], v down; +z is in the middle, −z at the
/// corners.
vec3 equal_area_direction(float u, float v);

/// Radiance of the environment as a square image with about two pixels for each of its own; each is the mean
/// over 16 places. World directions: the environment's rotation is in the image.
image::Image equal_area_image(const scene::Environment& environment);

}  // namespace ssphh::scene_io
