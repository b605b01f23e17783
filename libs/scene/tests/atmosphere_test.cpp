// The physical sky against published numbers, a slow integration of its own, and photons.

#include "../src/atmosphere.h"

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene {
namespace {

double sine(double degrees) {
  return std::sin(degrees * pi_d / 180);
}

// Hansen & Travis 1974: τ = 0.008569 λ⁻⁴ (1 + 0.0113 λ⁻² + 0.00013 λ⁻⁴).
TEST(Atmosphere, AirIsAsThickAsMeasured) {
  const Extinction extinction(3);
  const float column = columns_above(0, 1).air;
  for (std::size_t i = 0; i < spectrum_nanometres.size(); ++i) {
    const double l2 = std::pow(spectrum_nanometres[i] / 1000, -2);
    const double measured = 0.008569 * l2 * l2 * (1 + 0.0113 * l2 + 0.00013 * l2 * l2);
    EXPECT_NEAR(static_cast<double>(extinction.air[i] * column) / measured, 1, 0.015)
        << spectrum_nanometres[i];
  }
}

// Relative air mass of Kasten & Young 1989.
TEST(Atmosphere, WaysAreAsLongAsInTheRoundAir) {
  for (const double degrees : {90.0, 30.0, 10.0, 5.0}) {
    const double mass = 1 / (sine(degrees) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
    const float share = columns_above(0, sine(degrees)).air / columns_above(0, 1).air;
    EXPECT_NEAR(static_cast<double>(share) / mass, 1, 0.025) << degrees;
  }
}

// 133.1 klx outside of the atmosphere is what the sun's own spectrum gives (Preetham et al.); a black body of
// 5772 K gives 125.
TEST(Atmosphere, SunOutsideIsThatOfSpace) {
  Spectrum all;
  all.fill(1);
  const vec3 sun = sunlight_color(all);
  EXPECT_NEAR(110 * luminance(sun), 125'000, 2'000);
  EXPECT_NEAR(sun.x / sun.z, 1.06 / 0.945, 0.12);
}

/// Radiance of light scattered once, by plain sums: no table, fine even steps, optical depths summed anew at
/// each.
Spectrum slow_single(const Extinction& extinction, double cos_view, double cos_sun, double cos_between) {
  const double start = earth_radius + 2, top = earth_radius + atmosphere_height;
  const auto out = [&](double r, double mu) {
    return -r * mu + std::sqrt(r * r * mu * mu + top * top - r * r);
  };
  const auto columns = [&](double r, double mu, double length) {
    constexpr int steps = 500;
    glm::dvec3 sum(0);
    for (int i = 0; i < steps; ++i) {
      const double t = length * (i + 0.5) / steps,
                   h = std::sqrt(r * r + t * t + 2 * r * t * mu) - earth_radius;
      sum += length / steps *
             glm::dvec3(std::exp(-h / 8400), std::exp(-h / 1200),
                        std::max(0.0, 1 - std::abs(h - 25'000) / 15'000) / 15'000);
    }
    return Columns{static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)};
  };
  Spectrum result{};
  constexpr int steps = 2000;
  const double length = out(start, cos_view);
  for (int i = 0; i < steps; ++i) {
    // Even in the square root, so that the haze is met often
    const double a = length * std::pow(static_cast<double>(i) / steps, 2),
                 b = length * std::pow((i + 1.0) / steps, 2), t = 0.5 * (a + b);
    const double r = std::sqrt(start * start + t * t + 2 * start * t * cos_view);
    const double mu = (start * cos_sun + t * cos_between) / r;
    if (mu < -std::sqrt(1 - std::pow(earth_radius / r, 2))) continue;
    const Columns to_eye = columns(start, cos_view, t), to_sun = columns(r, mu, out(r, mu));
    const Spectrum through = extinction.transmittance(
        {to_eye.air + to_sun.air, to_eye.haze + to_sun.haze, to_eye.ozone + to_sun.ozone});
    const double h = r - earth_radius;
    for (std::size_t k = 0; k < result.size(); ++k) {
      const double scatters =
          air_phase(cos_between) * static_cast<double>(extinction.air[k]) * std::exp(-h / 8400) +
          haze_phase(cos_between) * static_cast<double>(extinction.haze_scattering[k]) * std::exp(-h / 1200);
      result[k] += static_cast<float>((b - a) * scatters * static_cast<double>(through[k]));
    }
  }
  return result;
}

TEST(Atmosphere, LightScatteredOnceIsThatOfASlowSum) {
  const Atmosphere air(3, vec3(0.2f));
  for (const double sun_degrees : {60.0, 20.0, 3.0}) {
    for (const double view_degrees : {80.0, 25.0, 4.0}) {
      for (const double azimuth : {0.4, 2.5}) {
        const double view = sine(view_degrees), sun = sine(sun_degrees);
        const double between =
            view * sun + std::sqrt((1 - view * view) * (1 - sun * sun)) * std::cos(azimuth);
        const SkyParts parts = air.scattered(view, sun, between);
        const Spectrum slow = slow_single(air.extinction(), view, sun, between);
        for (std::size_t k = 0; k < slow.size(); ++k) {
          const double quick = air_phase(between) * static_cast<double>(parts.by_air[k]) +
                               haze_phase(between) * static_cast<double>(parts.by_haze[k]);
          EXPECT_NEAR(quick / static_cast<double>(slow[k]), 1, 0.03)
              << sun_degrees << ' ' << view_degrees << ' ' << azimuth << ' ' << spectrum_nanometres[k];
        }
      }
    }
  }
}

/// Share of the sun's irradiance on a level plane that comes down from the sky, by photons through flat
/// layers of air, haze and ozone over a reflecting ground.
double photons_from_sky(const Extinction& extinction, std::size_t k, double cos_sun, double albedo) {
  constexpr int count = 30'000;
  const double air = static_cast<double>(extinction.air[k]) * 8400,
               haze = static_cast<double>(extinction.haze[k]) * 1200,
               ozone = static_cast<double>(extinction.ozone[k]), single = 0.95;
  Pcg32 random(7);
  const auto next = [&] { return static_cast<double>(random.uniform()); };
  double down = 0;
  for (int i = 0; i < count; ++i) {
    double mu = -cos_sun, height = 60'000, weight = 1;
    bool scattered = false;
    for (int order = 0; order < 200; ++order) {
      // Where the optical depth of air and haze along the way is reached; ozone, above both, dims at the top
      if (order == 0) weight *= std::exp(-ozone / cos_sun);
      const auto depth_above = [&](double h) {
        return air * std::exp(-h / 8400) + haze * std::exp(-h / 1200);
      };
      const double target = depth_above(height) - mu * -std::log(1 - next());
      if (target <= 0) break;  // into space
      if (target >= depth_above(0)) {
        if (scattered) down += weight;
        weight *= albedo;
        if (weight < 1e-3) break;
        mu = std::sqrt(next()), height = 0, scattered = true;
        continue;
      }
      double low = 0, high = 120'000;
      for (int step = 0; step < 50; ++step)
        (depth_above(0.5 * (low + high)) > target ? low : high) = 0.5 * (low + high);
      height = low;
      const double by_air = air / 8400 * std::exp(-height / 8400),
                   by_haze = haze / 1200 * std::exp(-height / 1200);
      double turn;
      if (next() * (by_air + by_haze) < by_air) {
        do turn = 2 * next() - 1;
        while (2 * next() > 1 + turn * turn);
      } else {
        constexpr double g = 0.76;
        weight *= single;
        const double s = (1 - g * g) / (1 - g + 2 * g * next());
        turn = (1 + g * g - s * s) / (2 * g);
      }
      scattered = true;
      mu = mu * turn + std::sqrt((1 - mu * mu) * (1 - turn * turn)) * std::cos(2 * pi_d * next());
    }
  }
  return down * cos_sun / count;
}

double sky_irradiance_share(const Atmosphere& air, std::size_t k, double cos_sun) {
  constexpr int rows = 24, columns = 16;
  double sum = 0;
  for (int row = 0; row < rows; ++row) {
    const double view = (row + 0.5) / rows;
    for (int column = 0; column < columns; ++column) {
      const double azimuth = pi_d * (column + 0.5) / columns;
      const double between =
          view * cos_sun + std::sqrt((1 - view * view) * (1 - cos_sun * cos_sun)) * std::cos(azimuth);
      sum +=
          2 * pi_d / (rows * columns) * view * static_cast<double>(air.radiance(view, cos_sun, between)[k]);
    }
  }
  return sum;
}

// All orders of scattering. The model takes what is scattered again for even in all directions: that costs a
// tenth over black ground, and a seventh where the ground sends half of the light back.
TEST(Atmosphere, SkylightIsThatOfPhotons) {
  for (const float albedo : {0.0f, 0.5f}) {
    const Atmosphere air(2.5f, vec3(albedo));
    for (const double degrees : {60.0, 25.0}) {
      for (const std::size_t k : {1U, 4U, 7U}) {
        const double photons =
            photons_from_sky(air.extinction(), k, sine(degrees), static_cast<double>(albedo));
        EXPECT_NEAR(sky_irradiance_share(air, k, sine(degrees)) / photons, 1, albedo > 0 ? 0.15 : 0.1)
            << albedo << ' ' << degrees << ' ' << spectrum_nanometres[k];
      }
    }
  }
}

double lux(const SunSkyParams& params) {
  const image::Image sky = sky_image(params);
  double sum = 0;
  for (int y = 0; y < sky.height / 2; ++y) {
    const double theta = pi_d * (y + 0.5) / sky.height;
    const double weight = 2 * pi_d / sky.width * std::sin(theta) * pi_d / sky.height * std::cos(theta);
    for (int x = 0; x < sky.width; ++x) sum += weight * static_cast<double>(luminance(sky.rgb(x, y)));
  }
  const double up = std::max(0.0, std::sin(static_cast<double>(params.elevation)));
  return 110 * (sum + up * static_cast<double>(luminance(sun_irradiance(params))));
}

// Illuminance of level ground by sun and sky on clear days and dusks (Explanatory Supplement to the
// Astronomical Almanac, 1992, table of natural illuminance). Haze varies it by a third on the day, and dusk
// by more.
TEST(Atmosphere, GroundIsAsBrightAsUnderClearSkies) {
  const struct {
    double degrees, lux, factor;
  } known[] = {{60, 102'000, 1.15}, {45, 83'000, 1.15}, {20, 32'000, 1.15}, {10, 10'900, 1.2},
               {0, 732, 1.5},       {-0.8, 453, 1.5},   {-6, 3.4, 2},       {-12, 8.31e-3, 2}};
  for (const auto& at : known) {
    const double found = lux({.elevation = static_cast<float>(at.degrees * pi_d / 180),
                              .turbidity = 2.5f,
                              .width = 64,
                              .model = SkyModel::physical});
    EXPECT_GT(found, at.lux / at.factor) << at.degrees;
    EXPECT_LT(found, at.lux * at.factor) << at.degrees;
  }
}

TEST(Atmosphere, DaysDusksAndNightsAreFiniteAndFadeAway) {
  float last = 1e9f;
  for (float degrees = 90; degrees >= -90; degrees -= 7.5f) {
    const SunSkyParams params{
        .elevation = glm::radians(degrees), .turbidity = 6, .width = 32, .model = SkyModel::physical};
    const image::Image sky = sky_image(params);
    float darkest = 1e9f;
    for (int y = 0; y < sky.height; ++y) {
      for (int x = 0; x < sky.width; ++x) {
        ASSERT_TRUE(is_finite(sky.rgb(x, y))) << degrees;
        if (y < sky.height / 2) darkest = std::min(darkest, luminance(sky.rgb(x, y)));
      }
    }
    EXPECT_GE(darkest, 0.99f * 2.5e-4f / 110) << degrees;
    if (degrees < 60) {  // with a high sun the darkest is far from it
      EXPECT_LE(darkest, last) << degrees;
    }
    last = darkest;
    if (degrees < -1) {
      EXPECT_EQ(sun_irradiance(params), vec3(0)) << degrees;
    }
  }
  EXPECT_NEAR(last, 2.5e-4f / 110, 1e-8f);
}

TEST(Atmosphere, TheSunSetsByAndBy) {
  EXPECT_EQ(visible_sun(0, sine(1)), 1);
  EXPECT_NEAR(visible_sun(0, 0), 0.5f, 1e-3f);
  EXPECT_EQ(visible_sun(0, sine(-1)), 0);
  EXPECT_GT(visible_sun(0, sine(0.1)), visible_sun(0, sine(-0.1)));
  EXPECT_EQ(visible_sun(10'000, sine(-1)), 1) << "seen from a mountain's height";
}

// The table behind images against the sum behind single directions.
TEST(Atmosphere, ImagesHaveTheRadianceOfTheirDirections) {
  for (const float degrees : {50.0f, 8.0f, -2.0f}) {
    const SunSkyParams params{.elevation = glm::radians(degrees), .width = 64, .model = SkyModel::physical};
    const image::Image sky = sky_image(params);
    for (int y = 0; y < 15; y += 2) {
      for (int x = 0; x < 64; x += 7) {
        const float phi = 2 * pi * ((static_cast<float>(x) + 0.5f) / 64 - 0.5f),
                    theta = pi * (static_cast<float>(y) + 0.5f) / 32;
        const vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        EXPECT_NEAR(luminance(sky.rgb(x, y)) / luminance(sky_radiance(params, d)), 1, 0.02f)
            << degrees << ' ' << x << ' ' << y;
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::scene
