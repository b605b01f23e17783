#pragma once
/// Sunlight in clear air around a round earth: what arrives of it, and what air and haze scatter. Lengths in
/// metres, heights above the sea; `cos_zenith` is the cosine of an angle from the vertical.
///
/// Air: Rayleigh scattering from its refractive index (Peck & Reeder 1972), King's factor for a
/// depolarization of 0.0279, 2.547e25 molecules per m³ at the ground, scale height 8400 m. Haze: Ångström's
/// law with exponent 1.3, β = 0.04608 T − 0.04586 of turbidity T (Preetham et al. 1999), scale height 1200 m,
/// a twentieth absorbed, Henyey–Greenstein g = 0.76. Ozone: 0.30 cm between 10 and 40 km, densest at 25 km,
/// absorption of Chappuis' band (Leckner 1978, in Iqbal 1983).

#include <memory>
#include <vector>

#include "spectrum.h"

namespace ssphh::scene {

inline constexpr double earth_radius = 6'371'000, atmosphere_height = 100'000, sun_radius = 0.00465;

/// Densities of air, haze and ozone along a way, as metres of the air and the haze at the ground and as the
/// share of the ozone above a place.
struct Columns {
  float air = 0, haze = 0, ozone = 0;
};
Columns densities_at(double height);
/// From a place out of the atmosphere, the earth left out, by a table made once.
Columns columns_above(double height, double cos_zenith);

/// Cosine of the angle from the vertical at which the earth's edge is seen.
double horizon_cos_zenith(double height);
/// Share of the sun's disc above that.
float visible_sun(double height, double cos_zenith);

/// Chance per steradian that light which is scattered turns by an angle.
double air_phase(double cosine);
double haze_phase(double cosine);

/// Coefficients at the ground [1/m]; of ozone, the optical depth of all above a place.
struct Extinction {
  Spectrum air, haze, haze_scattering, ozone;
  explicit Extinction(double turbidity);
  Spectrum transmittance(const Columns& columns) const;
};

/// Radiance as share of the sun's irradiance outside of the atmosphere [1/sr].
struct SkyParts {
  Spectrum by_air{}, by_haze{};  ///< scattered once; times its phase function
  Spectrum again{};              ///< scattered more often
};

class Atmosphere {
 public:
  /// A tenth of a second for the light that is scattered more than once.
  Atmosphere(float turbidity, const vec3& ground_albedo);

  /// Of the irradiance on a plane that faces the sun; 0 behind the earth.
  Spectrum sunlight(double height, double cos_zenith) const;
  /// Toward somebody at the ground from a direction above the horizon. `cos_between`: of the angle between
  /// direction and sun.
  SkyParts scattered(double cos_view, double cos_sun, double cos_between) const;
  /// What `scattered` says, with its phase functions.
  Spectrum radiance(double cos_view, double cos_sun, double cos_between) const;
  const Extinction& extinction() const { return extinction_; }

 private:
  Spectrum again_at(double height, double cos_sun) const;
  void find_again();
  Spectrum gather_again(double height, double cos_sun) const;

  Extinction extinction_;
  Spectrum albedo_;
  std::vector<Spectrum> again_;
};

/// One of these, kept for who asks for the same again, as an animation does.
std::shared_ptr<const Atmosphere> shared_atmosphere(float turbidity, const vec3& ground_albedo);

}  // namespace ssphh::scene
