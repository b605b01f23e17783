#include <algorithm>

#include <ssphh/image/sphere_map.h>

#include "bilinear.h"

namespace ssphh::image {

vec3 equirect_direction(float u, float v) {
  const float theta = pi * v, phi = 2 * pi * (u - 0.5f);
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

vec2 equirect_uv(const vec3& d) {
  const float horizontal = std::hypot(d.x, d.z);
  // atan2 is accurate near the poles, where acos is not.
  const float u = horizontal > 0 ? 0.5f + std::atan2(d.z, d.x) / (2 * pi) : 0.5f;
  return {std::clamp(u, 0.0f, 1.0f), std::atan2(horizontal, d.y) / pi};
}

double equirect_solid_angle(int y, int width, int height) {
  // cos θ₀ − cos θ₁ as a product, which keeps its digits in narrow rows.
  const double middle = pi_d * (y + 0.5) / height, half = pi_d / (2 * height);
  return 2 * pi_d / width * 2 * std::sin(middle) * std::sin(half);
}

vec3 sample_equirect(const Image& image, const vec3& direction) {
  return sample_equirect_at(image, equirect_uv(direction));
}

vec3 sample_equirect_at(const Image& image, const vec2& uv) {
  require(!image.empty(), "equirectangular image", "it is empty");
  const int width = image.width, height = image.height;
  const BilinearTap tap(uv.x * static_cast<float>(width), uv.y * static_cast<float>(height));
  return bilinear(tap, [&](int x, int y) {
    // Walking over a pole leads to the same row, half a turn away.
    if (y < 0 || y >= height) {
      y = y < 0 ? -1 - y : 2 * height - 1 - y;
      x += width / 2;
    }
    if (x < 0) x += width;
    if (x >= width) x -= width;
    return image.rgb(x, y);
  });
}

}  // namespace ssphh::image
