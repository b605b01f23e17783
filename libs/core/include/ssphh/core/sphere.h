#pragma once
/// Directions on the sphere: cube map geometry (docs/conventions.md#cube-maps) and point sets.

#include <ssphh/core/math.h>

namespace ssphh {

/// Cube faces in storage order, with OpenGL's orientation.
enum class CubeFace { positive_x, negative_x, positive_y, negative_y, positive_z, negative_z };

/// A place on a cube map: face index 0..5 in the order of CubeFace; s to the right and t down, both in [0, 1]
/// (t = 0 is the first row of the face's image).
struct CubePoint {
  int face;
  float s, t;
};

/// Direction (not normalised: the major component is ±1) of a place on the cube.
vec3 cube_direction_unnormalized(const CubePoint& point);

/// Unit direction of a place on the cube.
vec3 cube_direction(const CubePoint& point);

/// Where a direction (any length but zero) meets the cube.
CubePoint cube_point(const vec3& direction);

/// Unit direction of the centre of texel (x, y) of a face with size×size texels.
vec3 texel_direction(int face, int x, int y, int size);

/// Exact solid angle [sr] of texel (x, y), the same on every face; those of all 6·size² texels sum to 4π.
double texel_solid_angle(int x, int y, int size);

/// Point i of n of the spherical Fibonacci set (Keinert et al., Spherical Fibonacci Mapping, 2015), nearly
/// uniform.
vec3 spherical_fibonacci(int i, int n);

/// Uniform on the unit sphere from u in [0, 1)²; pdf 1/4π.
vec3 sample_uniform_sphere(const vec2& u);

/// Cosine-distributed on the hemisphere z ≥ 0; pdf z/π.
vec3 sample_cosine_hemisphere(const vec2& u);

}  // namespace ssphh
