#include "atmosphere.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <ssphh/core/parallel.h>

namespace ssphh::scene {
namespace {

constexpr std::size_t sun_nodes = 48, height_nodes = 16;

double index_of_air(double nanometres) {
  const double s = 1e6 / (nanometres * nanometres);  // µm⁻²
  return 1 + 1e-8 * (8060.51 + 2'480'990 / (132.274 - s) + 17'455.7 / (39.32957 - s));
}

double air_coefficient(double nanometres) {
  constexpr double molecules = 2.547e25, depolarization = 0.0279;
  const double n2 = std::pow(index_of_air(nanometres), 2) - 1, metres = nanometres * 1e-9;
  return 8 * std::pow(pi_d, 3) * n2 * n2 / (3 * molecules * std::pow(metres, 4)) * (6 + 3 * depolarization) /
         (6 - 7 * depolarization);
}

/// A point on a way from a place, and the sun as it stands there.
struct WayPoint {
  double height, cos_sun;
};

WayPoint way_point(double height, double cos_view, double cos_sun, double cos_between, double distance) {
  const double from = earth_radius + height;
  const double radius = std::sqrt(from * from + distance * distance + 2 * from * distance * cos_view);
  return {radius - earth_radius, std::clamp((from * cos_sun + distance * cos_between) / radius, -1.0, 1.0)};
}

/// Distance at which a way ends, and whether it does at the ground.
struct WayEnd {
  double distance;
  bool at_ground;
};

WayEnd way_end(double height, double cos_view) {
  const double radius = earth_radius + height, along = radius * cos_view;
  const auto sphere = [&](double other) { return along * along + (other - radius) * (other + radius); };
  if (cos_view < horizon_cos_zenith(height))
    return {-along - std::sqrt(std::max(0.0, sphere(earth_radius))), true};
  return {-along + std::sqrt(std::max(0.0, sphere(earth_radius + atmosphere_height))), false};
}

/// What light from the point scatters toward the eye per metre, by air and by haze.
struct Scattered {
  Spectrum air, haze;
};

/// Calls add(point, columns so far, share of the light that comes through, step) along a way: midpoints, the
/// denser the nearer.
template <class Add>
void march(const Extinction& extinction, double height, double cos_view, double cos_sun, double cos_between,
           double length, int steps, const Add& add) {
  Columns passed;
  for (int i = 0; i < steps; ++i) {
    const auto at = [&](double x) { return length * (x / steps) * (x / steps); };
    const double step = at(i + 1) - at(i);
    const WayPoint point = way_point(height, cos_view, cos_sun, cos_between, at(i + 0.5));
    const Columns here = densities_at(point.height);
    const auto half = static_cast<float>(0.5 * step);
    passed = {passed.air + half * here.air, passed.haze + half * here.haze, passed.ozone + half * here.ozone};
    add(point, here, extinction.transmittance(passed), static_cast<float>(step));
    passed = {passed.air + half * here.air, passed.haze + half * here.haze, passed.ozone + half * here.ozone};
  }
}

}  // namespace

double air_phase(double cosine) {
  return 3 / (16 * pi_d) * (1 + cosine * cosine);
}

double haze_phase(double cosine) {
  constexpr double g = 0.76;
  return (1 - g * g) / (4 * pi_d * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

Extinction::Extinction(double turbidity) {
  constexpr double scattered = 0.95, haze_height = 1200;
  const double beta = std::max(0.04608 * turbidity - 0.04586, 0.0);
  air = make_spectrum(air_coefficient);
  haze = make_spectrum([&](double nm) { return beta * std::pow(nm / 1000, -1.3) / haze_height; });
  for (std::size_t i = 0; i < haze.size(); ++i) haze_scattering[i] = static_cast<float>(scattered) * haze[i];
  constexpr Spectrum per_centimetre = {0, 0.003f, 0.017f, 0.057f, 0.110f, 0.130f, 0.073f, 0.032f};
  for (std::size_t i = 0; i < ozone.size(); ++i) ozone[i] = 0.30f * per_centimetre[i];
}

Spectrum Extinction::transmittance(const Columns& columns) const {
  Spectrum result;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = std::exp(-(air[i] * columns.air + haze[i] * columns.haze + ozone[i] * columns.ozone));
  return result;
}

Atmosphere::Atmosphere(float turbidity, const vec3& ground_albedo)
    : extinction_(static_cast<double>(turbidity)), albedo_(make_spectrum([&](double nm) {
        return ground_albedo[nm < 495 ? 2 : nm < 585 ? 1 : 0];
      })) {
  find_again();
}

Spectrum Atmosphere::sunlight(double height, double cos_zenith) const {
  const float seen = visible_sun(height, cos_zenith);
  if (!(seen > 0)) return {};
  // What shows of a sun that sets shines along the horizon
  Spectrum result =
      extinction_.transmittance(columns_above(height, std::max(cos_zenith, horizon_cos_zenith(height))));
  for (float& share : result) share *= seen;
  return result;
}

SkyParts Atmosphere::scattered(double cos_view, double cos_sun, double cos_between) const {
  constexpr double eye = 2;  // metres
  constexpr int steps = 48;
  SkyParts parts;
  march(extinction_, eye, cos_view, cos_sun, cos_between, way_end(eye, cos_view).distance, steps,
        [&](const WayPoint& point, const Columns& here, const Spectrum& through, float step) {
          const Spectrum sun = sunlight(point.height, point.cos_sun),
                         again = again_at(point.height, point.cos_sun);
          for (std::size_t i = 0; i < through.size(); ++i) {
            const float by_air = step * through[i] * here.air * extinction_.air[i];
            const float by_haze = step * through[i] * here.haze * extinction_.haze_scattering[i];
            parts.by_air[i] += by_air * sun[i];
            parts.by_haze[i] += by_haze * sun[i];
            parts.again[i] += (by_air + by_haze) * again[i];
          }
        });
  return parts;
}

Spectrum Atmosphere::radiance(double cos_view, double cos_sun, double cos_between) const {
  const SkyParts parts = scattered(cos_view, cos_sun, cos_between);
  const auto air = static_cast<float>(air_phase(cos_between)),
             haze = static_cast<float>(haze_phase(cos_between));
  Spectrum result;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = air * parts.by_air[i] + haze * parts.by_haze[i] + parts.again[i];
  return result;
}

// Light that was scattered more than once, as if it came from everywhere alike and as if that at a place were
// that around it (Hillaire, A Scalable and Production Ready Sky and Atmosphere Rendering Technique, 2020).
Spectrum Atmosphere::gather_again(double height, double cos_sun) const {
  constexpr int zeniths = 12, azimuths = 4, steps = 24;
  Spectrum twice{}, kept{};
  for (int z = 0; z < zeniths; ++z) {
    const double cos_view = -1 + 2 * (z + 0.5) / zeniths;
    const WayEnd end = way_end(height, cos_view);
    for (int a = 0; a < azimuths; ++a) {
      const double cos_between =
          cos_view * cos_sun + std::sqrt((1 - cos_view * cos_view) * (1 - cos_sun * cos_sun)) *
                                   std::cos(pi_d * (a + 0.5) / azimuths);
      Spectrum last{};
      constexpr float share = 1.0f / (zeniths * azimuths), isotropic = 1 / (4 * pi);
      march(extinction_, height, cos_view, cos_sun, cos_between, end.distance, steps,
            [&](const WayPoint& point, const Columns& here, const Spectrum& through, float step) {
              const Spectrum sun = sunlight(point.height, point.cos_sun);
              for (std::size_t i = 0; i < through.size(); ++i) {
                const float scattering =
                    share * step * through[i] *
                    (here.air * extinction_.air[i] + here.haze * extinction_.haze_scattering[i]);
                twice[i] += scattering * isotropic * sun[i];
                kept[i] += scattering;
              }
              last = through;
            });
      if (!end.at_ground) continue;
      const WayPoint ground = way_point(height, cos_view, cos_sun, cos_between, end.distance);
      const Spectrum sun = sunlight(0, ground.cos_sun);
      for (std::size_t i = 0; i < last.size(); ++i)
        twice[i] +=
            share * last[i] * albedo_[i] / pi * sun[i] * static_cast<float>(std::max(0.0, ground.cos_sun));
    }
  }
  for (std::size_t i = 0; i < twice.size(); ++i) twice[i] /= 1 - std::min(kept[i], 0.99f);
  return twice;
}

namespace {

/// Dense where the sun is near the horizon.
double sun_node(double place) {
  const double x = 2 * place / (sun_nodes - 1) - 1;
  return x * std::abs(x);
}

double height_node(double place) {
  const double x = place / (height_nodes - 1);
  return atmosphere_height * x * x;
}

}  // namespace

void Atmosphere::find_again() {
  again_.resize(height_nodes * sun_nodes);
  parallel_for(again_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      again_[i] = gather_again(height_node(static_cast<double>(i / sun_nodes)),
                               sun_node(static_cast<double>(i % sun_nodes)));
    }
  });
}

Spectrum Atmosphere::again_at(double height, double cos_sun) const {
  const double up = std::sqrt(std::clamp(height / atmosphere_height, 0.0, 1.0)) * (height_nodes - 1);
  const double root = std::sqrt(std::abs(cos_sun)),
               turn = 0.5 * ((cos_sun < 0 ? -root : root) + 1) * (sun_nodes - 1);
  const auto i = std::min(static_cast<std::size_t>(up), height_nodes - 2),
             j = std::min(static_cast<std::size_t>(std::max(turn, 0.0)), sun_nodes - 2);
  const auto s = static_cast<float>(up - static_cast<double>(i)),
             t = static_cast<float>(turn - static_cast<double>(j));
  const Spectrum* const at = &again_[i * sun_nodes + j];
  Spectrum result;
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = (1 - s) * ((1 - t) * at[0][k] + t * at[1][k]) +
                s * ((1 - t) * at[sun_nodes][k] + t * at[sun_nodes + 1][k]);
  return result;
}

std::shared_ptr<const Atmosphere> shared_atmosphere(float turbidity, const vec3& ground_albedo) {
  static std::mutex mutex;
  static std::shared_ptr<const Atmosphere> last;
  static std::pair<float, vec3> last_of;
  const std::pair asked{turbidity, ground_albedo};
  {
    const std::lock_guard lock(mutex);
    if (last && last_of == asked) return last;
  }
  auto made = std::make_shared<const Atmosphere>(turbidity, ground_albedo);
  const std::lock_guard lock(mutex);
  last = made, last_of = asked;
  return made;
}

}  // namespace ssphh::scene
