#pragma once
/// Directions on the sphere: cube map geometry (docs/conventions.md#cube-maps) and point sets.

#include <bit>
#include <cmath>
#include <cstdint>

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

/// (cos 2πt, sin 2πt) for t in [0, 1], within 2·10⁻⁷: faster than the library's, which serve any angle.
inline vec2 unit_circle(float t) {
  // Taylor series within an eighth turn of the nearest quarter; the first terms left out are below 3·10⁻⁸
  const float quarter = std::floor(4 * t + 0.5f);
  const float x = 2 * pi * (t - 0.25f * quarter), x2 = x * x;
  const float s = x * (1 + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 / 362880))));
  const float c = 1 + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 / 40320)));
  const auto q = static_cast<std::uint32_t>(static_cast<std::int32_t>(quarter));
  const auto with_sign = [](float value, std::uint32_t negative) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ (negative << 30));
  };
  return {with_sign(q & 1 ? s : c, (q + 1) & 2), with_sign(q & 1 ? c : s, q & 2)};
}

/// Uniform on the unit sphere from u in [0, 1)²; pdf 1/4π.
inline vec3 sample_uniform_sphere(const vec2& u) {
  const float z = 1 - 2 * u.x;
  return {std::sqrt(glm::max(0.0f, 1 - z * z)) * unit_circle(u.y), z};
}

/// Cosine-distributed on the hemisphere z ≥ 0; pdf z/π.
inline vec3 sample_cosine_hemisphere(const vec2& u) {
  return {std::sqrt(u.x) * unit_circle(u.y), std::sqrt(glm::max(0.0f, 1 - u.x))};
}

}  // namespace ssphh
