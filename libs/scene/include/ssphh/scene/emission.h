#pragma once
/// What an SPHL sends out: its radiant intensity I(ω) [W/sr] as spherical harmonics, ω a unit vector away
/// from the lamp in the lamp's own axes. Intensity, not radiance, so that a lamp of another radius gives the
/// same light. Where the sum of the harmonics is negative, nothing is sent.

#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/math.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::scene {

/// One frame for a lamp that stays as it is, or frames that follow each other at a steady rate.
struct Emission {
  std::vector<sh::IntensitySh> frames;  ///< at `start`, start + 1/rate, …; all of one degree
  float rate = 0;                       ///< frames per second; 0 where there is one frame
  float start = 0;                      ///< seconds
  /// After the last frame comes the first again, without end in both directions of time; else the first holds
  /// before `start` and the last after its time.
  bool repeat = false;

  friend bool operator==(const Emission&, const Emission&) = default;
};

inline constexpr std::size_t max_emission_frames = 10'000;

/// Throws Error with `where` as its place for no frame or more than max_emission_frames, frames that are
/// empty, not finite or of different degrees, and a rate that does not suit them.
void check_emission(const Emission& emission, const std::string& where);

/// The coefficients at `time` seconds, linear between frames; empty if there are no frames.
sh::IntensitySh emission_at(const Emission& emission, float time);

/// When the last frame has passed [s]; 0 for fewer than two frames.
float emission_end(const Emission& emission);

/// I(ω) ≥ 0 of coefficients whose degree is 0..10.
vec3 eval_intensity(const sh::IntensitySh& emission, const vec3& direction);

/// The axes of a lamp that stands at `world`: unit vectors, whatever its scale.
mat3 emission_axes(const mat4& world);

/// The mean over all directions, not below 0: a lamp that shines alike everywhere gives as much light as
/// these coefficients.
vec3 mean_intensity(const sh::IntensitySh& emission);

/// Shapes with names, of intensity 1 on their axis before they are cut off at a degree. `uniform`: the same
/// in all directions. `cosine`: max(0, cos θ), a small surface's. `beam`: exp(κ (cos θ − 1)), von
/// Mises–Fisher's lobe.
enum class Lobe { uniform, cosine, beam };
constexpr auto enum_table(Lobe) {
  using enum Lobe;
  return std::to_array<EnumName<Lobe>>({{uniform, "uniform"}, {cosine, "cosine"}, {beam, "beam"}});
}

/// Degree 10 cannot show narrower beams [rad].
inline constexpr float narrowest_beam = 15 * pi / 180;

/// A white lobe about the unit vector `axis`, of degree 10 (uniform: 0). `half_angle`: of a beam, where it
/// has half its intensity [rad]. Throws Error for an angle outside narrowest_beam..π or an axis without
/// length.
sh::IntensitySh lobe_emission(Lobe lobe, const vec3& axis, float half_angle);

}  // namespace ssphh::scene
