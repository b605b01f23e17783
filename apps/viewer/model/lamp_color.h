#pragma once
/// Colours of lamps as artists name them: sRGB in hexadecimal digits, and colour temperatures.

#include <optional>
#include <string>

#include <ssphh/core/vectors.h>

namespace ssphh::viewer {

/// "#ffe0b0" of linear Rec.709, clipped to 0..1.
std::string hex_of(const vec3& linear);
/// Linear Rec.709 of "#ffe0b0" or "ffe0b0", "#fe0"; none: it is no such colour.
std::optional<vec3> color_of_hex(const std::string& text);

inline constexpr float least_kelvin = 1667, most_kelvin = 25000;
/// Linear Rec.709 of a black body, its largest channel 1; what is outside the gamut is clipped. On the cubic
/// approximation of the Planckian locus of Kim et al. (US patent 7024034), within the limits above.
vec3 color_of_kelvin(float kelvin);
/// Correlated colour temperature of linear Rec.709 (McCamy, Correlated color temperature as an explicit
/// function of chromaticity coordinates, 1992), within the limits above; none: it is black.
std::optional<float> kelvin_of(const vec3& linear);

}  // namespace ssphh::viewer
