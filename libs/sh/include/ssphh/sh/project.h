#pragma once
/// Projection: S[k] = ∫ L(ω) Y_k(ω) dω. The sums are formed in a fixed order (same input, same bits). Inputs
/// with NaN or Inf give NaN or Inf coefficients.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include <ssphh/sh/coefficients.h>
#include <ssphh/sh/quadrature.h>

namespace ssphh::sh {

/// Σ_i weights[i] · radiance[i] · Y_k(directions[i]); directions are unit vectors, weights their solid angles
/// [sr]. The three spans have the same length.
RadianceSh project(int degree, std::span<const vec3> directions, std::span<const float> weights,
                   std::span<const vec3> radiance);
RadianceSh project(int degree, std::span<const vec3> directions, std::span<const double> weights,
                   std::span<const vec3> radiance);

/// Projection of a function by a quadrature rule (sphere_quadrature: exact for band-limited functions) or by
/// random points (stratified_sphere_samples), in double precision.
RadianceSh project(int degree, const SphereQuadrature& rule,
                   const std::function<vec3(const vec3&)>& radiance);

/// Six square faces in the order and orientation of ssphh::CubeFace, row 0 on top, each face_size² texels of
/// `channels` interleaved floats of which the first three are RGB.
using CubeFaces = std::array<std::span<const float>, 6>;

/// Projects cube maps of one size with exact texel solid angles (core/sphere.h). The basis is evaluated in
/// one octant only: Y_k is even or odd under each of the three mirrorings of the cube, so eight texels are
/// first combined into eight even/odd sums and every coefficient reads the one it needs. Make one and use it
/// for many cube maps.
class CubeProjector {
 public:
  /// 0 ≤ degree ≤ max_degree, face_size ≥ 1.
  CubeProjector(int degree, int face_size);

  /// `channels` is 3 or 4; each face must have face_size² · channels values.
  RadianceSh project(const CubeFaces& faces, int channels = 3) const;

  /// Multiply-adds that project() executes in its accumulation, for benchmarks.
  std::uint64_t executed_fma_count() const;

 private:
  int degree_, face_size_, half_;
  std::vector<float> half_coordinates_;  ///< s of the columns right of the centre
  // Per row and column of one quadrant, padded with 0 to whole SIMD blocks:
  std::vector<float> half_major_;         ///< 1 / length of (s, t, 1)
  std::vector<float> half_solid_angles_;  ///< [sr]
};

/// CubeProjector for a single cube map.
RadianceSh project_cube(int degree, int face_size, const CubeFaces& faces, int channels = 3);

}  // namespace ssphh::sh
