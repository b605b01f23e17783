#include "preetham.h"

#include <algorithm>
#include <cmath>

namespace ssphh::scene {
namespace {

constexpr double luminous_efficacy = 110;  // lm/W

double zenith_chromaticity(double t, double s, const double (&m)[3][4]) {
  const double powers[4] = {s * s * s, s * s, s, 1}, turbidity[3] = {t * t, t, 1};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) sum += turbidity[i] * m[i][j] * powers[j];
  }
  return sum;
}

/// Linear Rec.709 from CIE xyY; colours outside of it are clipped.
vec3 rgb_from_xyy(double x, double y, double luminance) {
  const double big_x = x / y * luminance, big_z = (1 - x - y) / y * luminance;
  const glm::dvec3 rgb(3.2404542 * big_x - 1.5371385 * luminance - 0.4985314 * big_z,
                       -0.9692660 * big_x + 1.8760108 * luminance + 0.0415560 * big_z,
                       0.0556434 * big_x - 0.2040259 * luminance + 1.0572252 * big_z);
  return vec3(glm::max(rgb, glm::dvec3(0)));
}

}  // namespace

double PreethamSky::Perez::at(double cos_theta, double gamma, double cos_gamma) const {
  return (1 + a * std::exp(b / cos_theta)) * (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
}

PreethamSky::PreethamSky(const SunSkyParams& params) {
  const auto t = static_cast<double>(params.turbidity);
  const double s = pi_d / 2 - static_cast<double>(params.elevation);
  const double chi = (4.0 / 9 - t / 120) * (pi_d - 2 * s);
  static constexpr double mx[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                      {-0.02903, 0.06377, -0.03202, 0.00394},
                                      {0.11693, -0.21196, 0.06052, 0.25886}};
  static constexpr double my[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                      {-0.04214, 0.08970, -0.04153, 0.00516},
                                      {0.15346, -0.26756, 0.06670, 0.26688}};
  luminance_ = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703};
  x_ = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
        -0.0033 * t + 0.0452};
  y_ = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
        -0.0109 * t + 0.0529};
  zenith_luminance_ = 1000 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);
  zenith_x_ = zenith_chromaticity(t, s, mx);
  zenith_y_ = zenith_chromaticity(t, s, my);
  sun_zenith_angle_ = s;
}

vec3 PreethamSky::radiance(float cos_view, float cos_between) const {
  // Toward the horizon exp(b / cos θ) goes to 0: stop before the division overflows.
  const double cos_theta = std::max(static_cast<double>(cos_view), 1e-4);
  const double cos_gamma = std::clamp(static_cast<double>(cos_between), -1.0, 1.0);
  const double gamma = std::acos(cos_gamma), s = sun_zenith_angle_;
  const auto relative = [&](const Perez& perez) {
    return perez.at(cos_theta, gamma, cos_gamma) / perez.at(1, s, std::cos(s));
  };
  const double luminance = std::max(0.0, zenith_luminance_ * relative(luminance_));
  return rgb_from_xyy(zenith_x_ * relative(x_), zenith_y_ * relative(y_), luminance / luminous_efficacy);
}

vec3 preetham_sun(const SunSkyParams& params) {
  // Relative air mass (Kasten & Young 1989) and transmittances (Iqbal 1983, as in Preetham et al., appendix
  // A.1).
  const double elevation = static_cast<double>(params.elevation);
  const double degrees = elevation * 180 / pi_d;
  const double mass = 1 / (std::sin(elevation) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
  const double haze = 0.04608 * static_cast<double>(params.turbidity) - 0.04586;
  static constexpr double wavelength[3] = {0.630, 0.540, 0.455};  // µm
  static constexpr double ozone[3] = {0.109, 0.072, 0.006};       // absorption per cm
  static constexpr double sun[3] = {1.06, 0.99, 0.945};  // colour of a black body of 5778 K, luminance 1
  vec3 result;
  for (int i = 0; i < 3; ++i) {
    const double air = std::exp(-0.008735 * std::pow(wavelength[i], -4.08) * mass);
    const double aerosol = std::exp(-haze * std::pow(wavelength[i], -1.3) * mass);
    const double absorbed = std::exp(-ozone[i] * 0.35 * mass);
    result[i] = static_cast<float>(133'100 / luminous_efficacy * sun[i] * air * aerosol * absorbed);
  }
  return result;
}

}  // namespace ssphh::scene
