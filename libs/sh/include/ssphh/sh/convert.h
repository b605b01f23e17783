#pragma once
/// Spherical harmonics of other programs, as one factor per coefficient. Only the basis is converted: scale
/// and sign. The axes are not. This project is right-handed, y up; of the targets
///   three.js, Godot, Filament   right-handed, y up: nothing to do
///   Unity                       left-handed, y up: mirror one axis first, z ↦ −z if scenes are imported that
///   way Unreal                      left-handed, z up, cm
/// which sh::Rotation does (mirrorings included): rotate, then convert; coming back, convert, then rotate.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

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

inline constexpr Convention all_conventions[] = {Convention::ssphh,    Convention::d3dx,
                                                 Convention::unity,    Convention::three,
                                                 Convention::filament, Convention::filament_mirrored};

/// "ssphh", "d3dx", "unity", "three", "filament", "filament-mirrored".
std::string_view convention_name(Convention convention);
/// Also knows the aliases "unreal", "godot" and "three.js"; empty for an unknown name.
std::optional<Convention> find_convention(std::string_view name);

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
