#pragma once
/// Quadratic zonal harmonics: bands 0 and 1 whole, band 2 as a lobe about the axis of band 1, which all
/// channels share (Roughton, Sloan, Silvennoinen, Iwanicki & Shirley, ZH3: Quadratic Zonal Harmonics, I3D
/// 2024). 15 numbers in place of 27; a function that is symmetric about that axis loses nothing.

#include <array>
#include <optional>

#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

struct Zh3 {
  std::array<vec3, 4> linear{};  ///< bands 0 and 1, as RadianceSh has them
  vec3 zonal{0};                 ///< coefficient of Y_20 about the axis
};

/// Unit vector along band 1 of the Rec.709 luminance; none where that is 0.
std::optional<vec3> zh3_axis(const std::array<vec3, 4>& linear);

/// Of all functions of this kind with these bands 0 and 1 the nearest in the mean square over directions.
/// Where there is no axis, `zonal` is 0. Throws Error unless the degree is 2 or more; bands over 2 are left
/// out.
Zh3 zh3_from(const RadianceSh& radiance);
/// The same about the axis of other bands 0 and 1, which the result has: such as were rounded.
Zh3 zh3_about(const std::array<vec3, 4>& linear, const RadianceSh& radiance);

/// The function, of degree 2.
RadianceSh to_sh(const Zh3& zh3);

}  // namespace ssphh::sh
