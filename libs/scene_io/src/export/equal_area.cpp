#include "equal_area.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/core/parallel.h>
#include <ssphh/image/sphere_map.h>

namespace ssphh::scene_io {

vec3 equal_area_direction(float u, float v) {
  const float x = 2 * u - 1, y = 2 * v - 1;
  const float ax = std::abs(x), ay = std::abs(y);
  const float inside = 1 - (ax + ay);  // signed distance from the diagonals: the equator
  const float r = 1 - std::abs(inside);
  const float phi = (r == 0 ? 1 : (ay - ax) / r + 1) * pi / 4;
  const float sin_theta = r * std::sqrt(glm::max(0.0f, 2 - r * r));
  return {std::copysign(std::cos(phi), x) * sin_theta, std::copysign(std::sin(phi), y) * sin_theta,
          std::copysign(1 - r * r, inside)};
}

image::Image equal_area_image(const scene::Environment& environment) {
  const image::Image& equirect = environment.equirect;
  const double pixels = static_cast<double>(equirect.width) * equirect.height;
  const int size = glm::clamp(static_cast<int>(std::ceil(std::sqrt(2 * pixels))), 16, 8192);
  constexpr int places = 4;
  const mat3 to_image(glm::rotate(mat4(1), -environment.rotation, vec3(0, 1, 0)));
  image::Image result(size, size);
  const auto mean_radiance = [&](int x, int y) {
    vec3 sum(0);
    for (int i = 0; i < places * places; ++i) {
      const float dx = (static_cast<float>(i % places) + 0.5f) / places;
      const float dy = (static_cast<float>(i / places) + 0.5f) / places;
      const vec3 direction = equal_area_direction((static_cast<float>(x) + dx) / static_cast<float>(size),
                                                  (static_cast<float>(y) + dy) / static_cast<float>(size));
      sum += image::sample_equirect(equirect, to_image * direction);
    }
    return environment.color * sum / static_cast<float>(places * places);
  };
  parallel_for(static_cast<std::size_t>(size), 1, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < size; ++x) result.set_rgb(x, y, mean_radiance(x, y));
  });
  return result;
}

}  // namespace ssphh::scene_io
