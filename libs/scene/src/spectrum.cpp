#include "spectrum.h"

#include <algorithm>
#include <cmath>

namespace ssphh::scene {
namespace {

/// A bell that is as wide as `below` on its one side and as `above` on the other.
double bell(double nanometres, double middle, double below, double above) {
  const double t = (nanometres - middle) / (nanometres < middle ? below : above);
  return std::exp(-0.5 * t * t);
}

glm::dvec3 color_matching(double nm) {
  return {1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7) -
              0.065 * bell(nm, 501.1, 20.4, 26.2),
          0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1),
          1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8)};
}

/// Of the sun outside of the atmosphere [W m⁻² nm⁻¹], by Planck's law.
double sun_irradiance_at(double nanometres) {
  constexpr double h = 6.62607015e-34, c = 299'792'458, k = 1.380649e-23, kelvin = 5772,
                   solid_angle = 6.794e-5;
  const double metres = nanometres * 1e-9;
  return 1e-9 * solid_angle * 2 * h * c * c / std::pow(metres, 5) / std::expm1(h * c / (metres * k * kelvin));
}

vec3 rec709_from_xyz(const glm::dvec3& xyz) {
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

/// The colour that a share of 1 at one wavelength has, and that falls to 0 toward the next ones.
std::array<vec3, spectrum_nanometres.size()> find_colors() {
  constexpr double efficacy = 683, daylight = 110;  // lm/W
  std::array<glm::dvec3, spectrum_nanometres.size()> xyz{};
  const double first = spectrum_nanometres.front(), last = spectrum_nanometres.back();
  const double step = spectrum_nanometres[1] - first;
  for (int nm = 380; nm <= 780; ++nm) {
    const double place = (std::clamp(static_cast<double>(nm), first, last) - first) / step;
    const auto below = std::min(static_cast<std::size_t>(place), xyz.size() - 2);
    const double t = place - static_cast<double>(below);
    const glm::dvec3 light = efficacy / daylight * sun_irradiance_at(nm) * color_matching(nm);
    xyz[below] += (1 - t) * light;
    xyz[below + 1] += t * light;
  }
  std::array<vec3, spectrum_nanometres.size()> colors;
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = rec709_from_xyz(xyz[i]);
  return colors;
}

}  // namespace

vec3 sunlight_color(const Spectrum& share) {
  static const auto colors = find_colors();
  vec3 sum(0);
  for (std::size_t i = 0; i < share.size(); ++i) sum += share[i] * colors[i];
  return glm::max(sum, vec3(0));
}

}  // namespace ssphh::scene
