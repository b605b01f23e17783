#pragma once
/// Light at a few wavelengths, and the colours that people see of it.

#include <array>
#include <cstddef>

#include <ssphh/core/math.h>

namespace ssphh::scene {

/// Of sunlight: the middles of bands of 40 nm.
inline constexpr std::array<double, 8> spectrum_nanometres = {405, 445, 485, 525, 565, 605, 645, 685};

/// A number for each of spectrum_nanometres.
using Spectrum = std::array<float, spectrum_nanometres.size()>;

template <class Function>
Spectrum make_spectrum(const Function& of_wavelength) {
  Spectrum result;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = static_cast<float>(of_wavelength(spectrum_nanometres[i]));
  return result;
}

/// Linear Rec.709 of what `share` leaves of the sun's light outside of the atmosphere, linear between the
/// wavelengths [W/m² for shares of irradiance; for shares per steradian W sr⁻¹ m⁻²]. The sun is a black body
/// of 5772 K (IAU 2015) seen under 6.794e-5 sr; the eye is CIE 1931 (Wyman, Sloan & Shirley, Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions, 2013). Luminance is divided by 110 lm/W,
/// daylight's luminous efficacy.
vec3 sunlight_color(const Spectrum& share);

}  // namespace ssphh::scene
