#include <ssphh/sh/convert.h>
#include <ssphh/sh/irradiance.h>

#include "object_grid.h"

namespace ssphh::probe_export {

/// As Babylon's SphericalHarmonics has them: its basis has the Condon–Shortley sign, and its shaders multiply
/// what they evaluate with the albedo alone.
Exported write_babylon(const ExportSource& source, const std::string& name, const Control& control) {
  std::array<ObjectColor, 9> colors;
  for (int k = 0; k < 9; ++k) {
    const int band = k == 0 ? 0 : k < 4 ? 1 : 2;
    colors[static_cast<std::size_t>(k)] = {
        k, sh::convention_factor(sh::Convention::d3dx, k) * sh::cosine_band_factor(band) / pi_d};
  }
  return write_object_grid(source, name, "babylon", colors, control);
}

}  // namespace ssphh::probe_export
