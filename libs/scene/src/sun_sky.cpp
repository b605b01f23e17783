#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene {
namespace {

constexpr double luminous_efficacy = 110;  // lm/W

/// Perez' five parameters for one of Y, x, y (Preetham et al., appendix A.2).
struct Perez {
  double a, b, c, d, e;

  double operator()(double cos_theta, double gamma, double cos_gamma) const {
    return (1 + a * std::exp(b / cos_theta)) * (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
  }
};

struct Sky {
  Perez luminance, x, y;
  double zenith_luminance, zenith_x, zenith_y;  // cd/m²; chromaticities
  double sun_zenith_angle;
};

double zenith_chromaticity(double t, double s, const double (&m)[3][4]) {
  const double powers[4] = {s * s * s, s * s, s, 1}, turbidity[3] = {t * t, t, 1};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) sum += turbidity[i] * m[i][j] * powers[j];
  }
  return sum;
}

Sky make_sky(const SunSkyParams& params) {
  const auto t = static_cast<double>(params.turbidity);
  const double s = pi_d / 2 - static_cast<double>(params.elevation);
  const double chi = (4.0 / 9 - t / 120) * (pi_d - 2 * s);
  static constexpr double mx[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                      {-0.02903, 0.06377, -0.03202, 0.00394},
                                      {0.11693, -0.21196, 0.06052, 0.25886}};
  static constexpr double my[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                      {-0.04214, 0.08970, -0.04153, 0.00516},
                                      {0.15346, -0.26756, 0.06670, 0.26688}};
  return {
      .luminance = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                    -0.0670 * t + 0.3703},
      .x = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
            -0.0033 * t + 0.0452},
      .y = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
            -0.0109 * t + 0.0529},
      .zenith_luminance = 1000 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192),
      .zenith_x = zenith_chromaticity(t, s, mx),
      .zenith_y = zenith_chromaticity(t, s, my),
      .sun_zenith_angle = s,
  };
}

/// Linear Rec.709 from CIE xyY; colours outside of it are clipped.
vec3 rgb_from_xyy(double x, double y, double luminance) {
  const double big_x = x / y * luminance, big_z = (1 - x - y) / y * luminance;
  const glm::dvec3 rgb(3.2404542 * big_x - 1.5371385 * luminance - 0.4985314 * big_z,
                       -0.9692660 * big_x + 1.8760108 * luminance + 0.0415560 * big_z,
                       0.0556434 * big_x - 0.2040259 * luminance + 1.0572252 * big_z);
  return vec3(glm::max(rgb, glm::dvec3(0)));
}

vec3 radiance(const Sky& sky, const vec3& to_sun, const vec3& direction) {
  // Toward the horizon exp(b / cos θ) goes to 0: stop before the division overflows.
  const double cos_theta = std::max(static_cast<double>(direction.y), 1e-4);
  const double cos_gamma = std::clamp(static_cast<double>(glm::dot(direction, to_sun)), -1.0, 1.0);
  const double gamma = std::acos(cos_gamma), s = sky.sun_zenith_angle;
  const auto relative = [&](const Perez& perez) {
    return perez(cos_theta, gamma, cos_gamma) / perez(1, s, std::cos(s));
  };
  const double luminance = std::max(0.0, sky.zenith_luminance * relative(sky.luminance));
  return rgb_from_xyy(sky.zenith_x * relative(sky.x), sky.zenith_y * relative(sky.y),
                      luminance / luminous_efficacy);
}

void check(const SunSkyParams& p) {
  const auto require = [](bool good, const char* name, float value, const char* range) {
    if (!good)
      throw Error(fmt::format("sun and sky: {}", name), fmt::format("{} is out of range", value), range);
  };
  require(p.elevation >= 0 && p.elevation <= pi / 2 + 1e-5f, "elevation", p.elevation,
          "the model knows 0 to π/2 (90°)");
  require(p.turbidity >= 1.7f && p.turbidity <= 10, "turbidity", p.turbidity, "the model knows 1.7 to 10");
  require(std::isfinite(p.azimuth), "azimuth", p.azimuth, "give an angle");
  require(is_finite(p.ground_albedo), "ground albedo", p.ground_albedo.x, "give numbers from 0 to 1");
  require(p.width >= 4 && p.width <= 16384, "width", static_cast<float>(p.width), "4 to 16384 pixels");
}

/// Direction of an equirectangular pixel's centre: u = ½ + atan2(z, x)/2π, v = θ/π from +y.
vec3 equirect_direction(int x, int y, int width, int height) {
  const double phi = 2 * pi_d * ((x + 0.5) / width - 0.5), theta = pi_d * (y + 0.5) / height;
  return vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
}

}  // namespace

vec3 sun_direction(const SunSkyParams& params) {
  const float across = std::cos(params.elevation);
  return {across * std::cos(params.azimuth), std::sin(params.elevation), across * std::sin(params.azimuth)};
}

vec3 sky_radiance(const SunSkyParams& params, const vec3& direction) {
  check(params);
  return radiance(make_sky(params), sun_direction(params), direction);
}

vec3 sun_irradiance(const SunSkyParams& params) {
  check(params);
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

void add_sun_sky(Scene& scene, const SunSkyParams& params) {
  check(params);
  const Sky sky = make_sky(params);
  const vec3 to_sun = sun_direction(params), sun = sun_irradiance(params);

  // Upper half: the sky. Its irradiance on the ground on the way, row by row.
  Environment environment;
  environment.name = environment.group = "sky";
  const int width = params.width, height = (width + 1) / 2;
  environment.equirect = image::Image(width, height, 3);
  std::vector<glm::dvec3> row_irradiance(static_cast<std::size_t>(height), glm::dvec3(0));
  parallel_for(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row);
      const double top = std::cos(pi_d * y / height), bottom = std::cos(pi_d * (y + 1) / height);
      for (int x = 0; x < width; ++x) {
        const vec3 direction = equirect_direction(x, y, width, height);
        if (!(direction.y > 0)) continue;
        const vec3 color = radiance(sky, to_sun, direction);
        environment.equirect.set_rgb(x, y, color);
        row_irradiance[row] +=
            2 * pi_d / width * (top - bottom) * static_cast<double>(direction.y) * glm::dvec3(color);
      }
    }
  });
  glm::dvec3 irradiance(0);
  for (const glm::dvec3& row : row_irradiance) irradiance += row;

  // Lower half: the ground reflects both.
  if (params.sun) irradiance += static_cast<double>(to_sun.y) * glm::dvec3(sun);
  const vec3 ground = params.ground_albedo * vec3(irradiance) / pi;
  for (int y = 0; y < height; ++y) {
    if (equirect_direction(0, y, width, height).y > 0) continue;
    for (int x = 0; x < width; ++x) environment.equirect.set_rgb(x, y, ground);
  }
  scene.environment = std::move(environment);
  if (!params.sun) return;

  // The sun shines along −z of its node.
  const vec3 up = std::abs(to_sun.y) > 0.999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
  Node node;
  node.name = "sun";
  node.local.rotation = glm::normalize(glm::quatLookAt(-to_sun, up));
  scene.nodes.push_back(std::move(node));
  Light light;
  light.name = light.group = "sun";
  light.node = static_cast<int>(scene.nodes.size()) - 1;
  light.type = LightType::directional;
  light.intensity = max_component(sun);
  light.color = light.intensity > 0 ? sun / light.intensity : vec3(1);
  light.angular_radius = 0.00465f;
  scene.lights.push_back(std::move(light));
}

}  // namespace ssphh::scene
