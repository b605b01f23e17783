#include <cmath>

#include <ssphh/image/sphere_map.h>
#include <ssphh/scene/studio.h>

namespace ssphh::scene {
namespace {

/// A soft light: 1 toward it, half as much 15° to 25° beside.
float lobe(const vec3& direction, const vec3& toward, float sharpness) {
  return std::exp(sharpness * (glm::dot(direction, glm::normalize(toward)) - 1));
}

}  // namespace

float studio_radiance(const vec3& direction) {
  const float walls = 0.25f + 0.45f * glm::smoothstep(-0.4f, 1.0f, direction.y);
  return walls + 3 * lobe(direction, {1, 1.6f, 1.2f}, 12) + 0.8f * lobe(direction, {-2, 1, 0.5f}, 8);
}

void add_studio(Scene& scene) {
  constexpr int width = 256, height = width / 2;
  Environment studio;
  studio.name = "studio";
  studio.equirect = image::Image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec3 direction = image::equirect_direction((static_cast<float>(x) + 0.5f) / width,
                                                       (static_cast<float>(y) + 0.5f) / height);
      studio.equirect.set_rgb(x, y, vec3(studio_radiance(direction)));
    }
  }
  scene.environment = std::move(studio);
}

}  // namespace ssphh::scene
