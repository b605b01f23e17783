#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require_named.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>

#include "physical_sky.h"
#include "preetham.h"

namespace ssphh::scene {
namespace {

void check_sky(const SunSkyParams& p) {
  const auto require = [](bool good, const char* name, float value, const char* range) {
    if (!good)
      throw Error(fmt::format("sun and sky: {}", name), fmt::format("{} is out of range", value), range);
  };
  require_named("sky model", p.model);
  const bool physical = p.model == SkyModel::physical;
  require(p.elevation >= (physical ? -pi / 2 - 1e-5f : 0) && p.elevation <= pi / 2 + 1e-5f, "elevation",
          p.elevation,
          physical ? "-π/2 to π/2 (90°)"
                   : "Preetham's model knows 0 to π/2 (90°); the physical sky has dusk and night, too");
  require(p.turbidity >= 1.7f && p.turbidity <= 10, "turbidity", p.turbidity, "the model knows 1.7 to 10");
  require(std::isfinite(p.azimuth), "azimuth", p.azimuth, "give an angle");
  require(is_finite(p.ground_albedo), "ground albedo", p.ground_albedo.x, "give numbers from 0 to 1");
  require(p.width >= 4 && p.width <= 16384, "width", static_cast<float>(p.width), "4 to 16384 pixels");
}

std::variant<PreethamSky, PhysicalSky> make_sky(const SunSkyParams& params) {
  if (params.model == SkyModel::physical) return PhysicalSky(params);
  return PreethamSky(params);
}

/// Direction of an equirectangular pixel's centre: u = ½ + atan2(z, x)/2π, v = θ/π from +y.
vec3 equirect_direction(int x, int y, int width, int height) {
  const double phi = 2 * pi_d * ((x + 0.5) / width - 0.5), theta = pi_d * (y + 0.5) / height;
  return vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
}

/// The sun shines along −z.
quat sun_rotation(const vec3& to_sun) {
  const vec3 up = std::abs(to_sun.y) > 0.999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
  return glm::normalize(glm::quatLookAt(-to_sun, up));
}

struct SunColor {
  float intensity;
  vec3 color;
};

SunColor sun_color(const vec3& irradiance) {
  const float intensity = max_component(irradiance);
  return {intensity, intensity > 0 ? irradiance / intensity : vec3(1)};
}

}  // namespace

SunSkyParams at_time(SunSkyParams params, const SunTime& time) {
  const SunPosition position = sun_position(time);
  params.elevation = static_cast<float>(position.elevation * pi_d / 180);
  params.azimuth = static_cast<float>((position.azimuth + time.north - 90) * pi_d / 180);
  params.time = time;
  return params;
}

vec3 sun_direction(const SunSkyParams& params) {
  const float across = std::cos(params.elevation);
  return {across * std::cos(params.azimuth), std::sin(params.elevation), across * std::sin(params.azimuth)};
}

vec3 sky_radiance(const SunSkyParams& params, const vec3& direction) {
  check_sky(params);
  if (params.model == SkyModel::physical) return physical_radiance(params, direction);
  return PreethamSky(params).radiance(direction.y, glm::dot(direction, sun_direction(params)));
}

vec3 sun_irradiance(const SunSkyParams& params) {
  check_sky(params);
  return params.model == SkyModel::physical ? physical_sun(params) : preetham_sun(params);
}

image::Image sky_image(const SunSkyParams& params) {
  check_sky(params);
  const auto sky = make_sky(params);
  const vec3 to_sun = sun_direction(params), sun = sun_irradiance(params);

  // Upper half: the sky. Its irradiance on the ground on the way, row by row.
  const int width = params.width, height = (width + 1) / 2;
  image::Image image(width, height, 3);
  std::vector<glm::dvec3> row_irradiance(static_cast<std::size_t>(height), glm::dvec3(0));
  parallel_for(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row);
      const double top = std::cos(pi_d * y / height), bottom = std::cos(pi_d * (y + 1) / height);
      for (int x = 0; x < width; ++x) {
        const vec3 direction = equirect_direction(x, y, width, height);
        if (!(direction.y > 0)) continue;
        const vec3 color = std::visit(
            [&](const auto& model) { return model.radiance(direction.y, glm::dot(direction, to_sun)); }, sky);
        image.set_rgb(x, y, color);
        row_irradiance[row] +=
            2 * pi_d / width * (top - bottom) * static_cast<double>(direction.y) * glm::dvec3(color);
      }
    }
  });
  glm::dvec3 irradiance(0);
  for (const glm::dvec3& row : row_irradiance) irradiance += row;

  // Lower half: the ground reflects both.
  if (params.sun) irradiance += static_cast<double>(std::max(to_sun.y, 0.0f)) * glm::dvec3(sun);
  const vec3 ground = params.ground_albedo * vec3(irradiance) / pi;
  for (int y = 0; y < height; ++y) {
    if (equirect_direction(0, y, width, height).y > 0) continue;
    for (int x = 0; x < width; ++x) image.set_rgb(x, y, ground);
  }
  return image;
}

SunSky make_sun_sky(const SunSkyParams& params) {
  return {params, std::make_shared<const image::Image>(sky_image(params)),
          params.sun ? sun_irradiance(params) : vec3(0)};
}

int sun_light(const Scene& scene) {
  if (!scene.environment || !scene.environment->sun_sky) return -1;
  const auto sun = std::ranges::find_if(scene.lights, [](const Light& light) {
    return light.type == LightType::directional && light_group(light) == "sun";
  });
  return sun == scene.lights.end() ? -1 : static_cast<int>(sun - scene.lights.begin());
}

void add_sun_sky(Scene& scene, const SunSkyParams& params) {
  Environment environment;
  environment.equirect = sky_image(params);
  environment.name = environment.group = "sky";
  environment.sun_sky = params;
  if (const int before = sun_light(scene); before >= 0) scene.lights.erase(scene.lights.begin() + before);
  scene.environment = std::move(environment);
  if (!params.sun) return;

  Node node;
  node.name = "sun";
  node.local.rotation = sun_rotation(sun_direction(params));
  scene.nodes.push_back(std::move(node));
  Light light;
  light.name = light.group = "sun";
  light.node = static_cast<int>(scene.nodes.size()) - 1;
  light.type = LightType::directional;
  const auto [intensity, color] = sun_color(sun_irradiance(params));
  light.intensity = intensity;
  light.color = color;
  light.angular_radius = static_cast<float>(sun_radius);
  scene.lights.push_back(std::move(light));
}

void set_sun_sky(LightingState& state, const Scene& scene, const SunSky& sky) {
  if (!scene.environment || !scene.environment->sun_sky)
    throw Error("sky", "the scene's environment is no computed sky", "give --sky physical");
  state.environment_image = sky.image;
  const int sun = sun_light(scene);
  if (sun < 0) return;
  LightState& now = state.lights.at(static_cast<std::size_t>(sun));
  const quat turn = glm::angleAxis(scene.environment->rotation, vec3(0, 1, 0));
  now.world = glm::mat4_cast(turn * sun_rotation(sun_direction(sky.params)));
  const auto [intensity, color] = sun_color(sky.sun);
  now.intensity = intensity;
  now.color = color;
}

}  // namespace ssphh::scene
