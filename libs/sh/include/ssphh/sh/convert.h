#pragma once
/// Spherical harmonics of other programs, as one factor per coefficient. Only the basis is converted: scale
/// and sign. The axes are not. This project is right-handed, y up; of the targets
///   three.js, Godot, Filament   right-handed, y up: nothing to do
///   Unity                       left-handed, y up: mirror one axis first, z ↦ −z if scenes are imported that
///   way Unreal                      left-handed, z up, cm
/// which sh::Rotation does (mirrorings included): rotate, then convert; coming back, convert, then rotate.

#include <span>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

enum class Convention {
  ssphh,     ///< radiance, no Condon–Shortley sign (docs/conventions.md)
  d3dx,      ///< radiance, sign (−1)^m: D3DX, DirectXMath SH, Unreal (any degree)
  unity,     ///< SphericalHarmonicsL2: E/π with the basis constants multiplied in, plain polynomials
  three,     ///< radiance in this project's basis, degree 2: three.js LightProbe, Godot LightmapGI probes
  filament,  ///< E/π with the basis constants multiplied in, as Filament's shaders evaluate it
  filament_mirrored  ///< the same of the mirror image x ↦ −x: files written by cmgen without --no-mirror
};
constexpr auto enum_table(Convention) {
  using enum Convention;
  return std::to_array<EnumName<Convention>>({{ssphh, "ssphh"},
                                              {d3dx, "d3dx"},
                                              {d3dx, "unreal"},
                                              {unity, "unity"},
                                              {three, "three"},
                                              {three, "three.js"},
                                              {three, "godot"},
                                              {filament, "filament"},
                                              {filament_mirrored, "filament-mirrored"}});
}

/// Highest degree that the convention stores.
int convention_max_degree(Convention convention);

/// Stored value = factor · coefficient k of this project. Never 0. k <
/// coefficient_count(convention_max_degree).
double convention_factor(Convention convention, int k);

/// Stored values of a foreign convention; bands above convention_max_degree are dropped.
std::vector<vec3> to_convention(const RadianceSh& radiance, Convention convention);

/// The radiance coefficients behind stored values. Throws Error unless their number is 1, 4, 9 … up to the
/// convention's degree and all are finite.
RadianceSh from_convention(std::span<const vec3> stored, Convention convention);

}  // namespace ssphh::sh
