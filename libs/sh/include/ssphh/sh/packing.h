#pragma once
/// Radiance as SH in fewer bytes than floats: what probe files hold if asked to (docs/compact-probes.md has
/// the layouts, and what each loses in real scenes).

#include <cstddef>
#include <span>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::sh {

enum class Packing {
  none,    ///< floats, every bit
  half,    ///< IEEE 754 binary16 with one power of two for all, so that bright lamps do not overflow
  rgb9e5,  ///< band 0 as RGB9E5, the others as signed bytes in shares of the most that light can have there
  zh3,     ///< the same of Zh3's fifteen numbers
  bc6h,  ///< an octahedral map of irradiance as a GPU's texture has it: 4×4 texels for degree 2, 8×8 for 4
};
constexpr auto enum_table(Packing) {
  using enum Packing;
  return std::to_array<EnumName<Packing>>(
      {{none, "none"}, {half, "half"}, {rgb9e5, "rgb9e5"}, {zh3, "zh3"}, {bc6h, "bc6h"}});
}

/// It carries functions of that degree.
constexpr bool packs(Packing packing, int degree) {
  if (packing == Packing::zh3) return degree == 2;
  if (packing == Packing::bc6h) return degree == 2 || degree == 4;
  return degree >= 0 && degree <= max_degree;
}

/// Bytes of a function of that degree.
constexpr std::size_t packed_bytes(Packing packing, int degree) {
  const auto k = static_cast<std::size_t>(coefficient_count(degree));
  switch (packing) {
    case Packing::none:
      return 12 * k;
    case Packing::half:
      return 1 + 6 * k;
    case Packing::rgb9e5:
      return 4 + 3 * (k - 1);
    case Packing::zh3:
      return 4 + 9 + 3;
    case Packing::bc6h:
      return degree <= 2 ? 1 + 16 : 1 + 4 * 16;
  }
  return 0;
}

/// Appends packed_bytes() to `out`. The errors, for light that is nowhere negative:
///
///   half    each coefficient is rounded by 2⁻¹¹ of itself, or 2⁻³⁹ of the largest if that is more
///   rgb9e5  band 0 by 2⁻⁹ of its largest channel; each other coefficient of band l by √(2l+1)/254 of its
///           channel's coefficient 0, and by what rounding took from that
///   zh3     the same, and what of band 2 is no lobe about the axis
///   bc6h    no bound: colours of a block that lie far from one line or two come near to them. Band 3, which
///           irradiance does not have, is lost
///
/// Light that is somewhere negative may have more in a band than rgb9e5 and zh3 hold and is cut there, and
/// bc6h cuts irradiance below −1/2 of its mean; with all three, a channel whose coefficient 0 is negative
/// becomes dark. Throws Error, and appends nothing, for numbers that are not finite, for a degree that the
/// packing does not have (zh3: other than 2; bc6h: other than 2 and 4), and where coefficient 0 is over
/// 65408, RGB9E5's most (rgb9e5, zh3).
void pack(const RadianceSh& radiance, Packing packing, std::vector<std::byte>& out);

/// The function again: pack() of it gives the same bytes with `none` and `half`. Throws Error unless there
/// are packed_bytes() and packs() is true. Bytes that pack() does not write may give numbers that are not
/// finite.
RadianceSh unpack(std::span<const std::byte> bytes, Packing packing, int degree);

}  // namespace ssphh::sh
