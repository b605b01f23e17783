// The numbers of the sky's model, each table evaluated apart from the code's.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene {
namespace {

using Chromaticity = glm::dvec2;

/// CIE x and y of a linear Rec.709 colour (IEC 61966-2-1).
Chromaticity chromaticity(const vec3& rgb) {
  const glm::dvec3 c(rgb);
  const double x = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, y = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
               z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z;
  return {x / (x + y + z), y / (x + y + z)};
}

constexpr double turbidity = 4, zenith_angle = 0.9;  // of the sun
const SunSkyParams params{
    .elevation = static_cast<float>(pi_d / 2 - zenith_angle), .azimuth = 0, .turbidity = 4};

// Preetham et al., appendix A.2, for T = 4 (T² = 16): each power of the angle has the coefficient T² a + T b
// + c.
TEST(SunSkyTables, ZenithHasTheModelsChromaticity) {
  const double s = zenith_angle;
  const double x = (16 * 0.00166 - 4 * 0.02903 + 0.11693) * s * s * s +
                   (16 * -0.00375 + 4 * 0.06377 - 0.21196) * s * s +
                   (16 * 0.00209 - 4 * 0.03202 + 0.06052) * s + (4 * 0.00394 + 0.25886);
  const double y = (16 * 0.00275 - 4 * 0.04214 + 0.15346) * s * s * s +
                   (16 * -0.00610 + 4 * 0.08970 - 0.26756) * s * s +
                   (16 * 0.00317 - 4 * 0.04153 + 0.06670) * s + (4 * 0.00516 + 0.26688);
  const Chromaticity zenith = chromaticity(sky_radiance(params, {0, 1, 0}));
  EXPECT_NEAR(zenith.x, x, 5e-5);  // matrices rounded to four digits
  EXPECT_NEAR(zenith.y, y, 5e-5);
}

/// (1 + A e^(B / cos θ)) (1 + C e^(D γ) + E cos² γ), the coefficients T a + b of appendix A.2.
double perez(const double (&slopes)[5], const double (&offsets)[5], double theta, double gamma) {
  double k[5];
  for (int i = 0; i < 5; ++i) k[i] = turbidity * slopes[i] + offsets[i];
  return (1 + k[0] * std::exp(k[1] / std::cos(theta))) *
         (1 + k[2] * std::exp(k[3] * gamma) + k[4] * std::cos(gamma) * std::cos(gamma));
}

TEST(SunSkyTables, LuminanceAndColourFallOffAsPerezSays) {
  const double slopes_y[5] = {0.1787, -0.3554, -0.0227, 0.1206, -0.0670},
               offsets_y[5] = {-1.4630, 0.4275, 5.3251, -2.5771, 0.3703};
  const double slopes_cx[5] = {-0.0193, -0.0665, -0.0004, -0.0641, -0.0033},
               offsets_cx[5] = {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452};
  const double slopes_cy[5] = {-0.0167, -0.0950, -0.0079, -0.0441, -0.0109},
               offsets_cy[5] = {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529};
  const vec3 zenith = sky_radiance(params, {0, 1, 0});
  const Chromaticity at_zenith = chromaticity(zenith);
  for (const double theta : {0.3, 0.7, 1.2, 1.5}) {
    for (const double phi : {0.0, 0.8, 2.0, 3.1}) {  // from the sun's azimuth
      const vec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      const double gamma = std::acos(std::cos(theta) * std::cos(zenith_angle) +
                                     std::sin(theta) * std::sin(zenith_angle) * std::cos(phi));
      const auto ratio = [&](const double(&slopes)[5], const double(&offsets)[5]) {
        return perez(slopes, offsets, theta, gamma) / perez(slopes, offsets, 0, zenith_angle);
      };
      const vec3 sky = sky_radiance(params, direction);
      const Chromaticity color = chromaticity(sky);
      SCOPED_TRACE(testing::Message() << "θ " << theta << " φ " << phi);
      // Weights and matrices of four digits; float directions near the sun
      EXPECT_NEAR(static_cast<double>(luminance(sky) / luminance(zenith)) / ratio(slopes_y, offsets_y), 1,
                  3e-4);
      EXPECT_NEAR(color.x / at_zenith.x, ratio(slopes_cx, offsets_cx), 1e-4);
      EXPECT_NEAR(color.y / at_zenith.y, ratio(slopes_cy, offsets_cy), 1e-4);
    }
  }
}

// Beer's law through Kasten and Young's air mass at 30°, 1.994: Rayleigh, haze (Ångström), 0.35 cm of ozone.
// The sun outside is a black body of 5778 K whose luminance is 133.1 klx at 110 lm/W.
TEST(SunSkyTables, SunIsDimmedByAirHazeAndOzone) {
  const double mass = 1 / (0.5 + 0.50572 * std::pow(30 + 6.07995, -1.6364));
  EXPECT_NEAR(mass, 1.994, 1e-3);
  const double haze = 0.04608 * 4 - 0.04586;
  const double wavelength[3] = {0.630, 0.540, 0.455}, ozone[3] = {0.109, 0.072, 0.006};
  const double outside[3] = {1.06, 0.99, 0.945};
  const vec3 sun = sun_irradiance({.elevation = pi / 6, .turbidity = 4});
  for (int i = 0; i < 3; ++i) {
    const double depth =
        0.008735 * std::pow(wavelength[i], -4.08) + haze * std::pow(wavelength[i], -1.3) + 0.35 * ozone[i];
    EXPECT_NEAR(static_cast<double>(sun[i]) / (1210 * outside[i] * std::exp(-mass * depth)), 1, 1e-5)
        << i;  // floats
  }
}

TEST(SunSkyTables, DefaultIsAClearDayAndTheSunsDiscHasItsSize) {
  const SunSkyParams left_out;
  EXPECT_FLOAT_EQ(left_out.elevation, pi / 4);
  EXPECT_FLOAT_EQ(left_out.azimuth, pi / 6);
  EXPECT_EQ(left_out.turbidity, 3);
  EXPECT_EQ(left_out.ground_albedo, vec3(0.2f));
  Scene scene;
  add_sun_sky(scene, {.width = 16});
  const Light& sun = scene.lights.at(0);
  EXPECT_EQ(sun.angular_radius, 0.00465f);
  const vec3 irradiance = sun_irradiance(left_out);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(sun.intensity * sun.color[c], irradiance[c]);
  EXPECT_EQ(scene.environment->equirect.height, 8);
}

}  // namespace
}  // namespace ssphh::scene
