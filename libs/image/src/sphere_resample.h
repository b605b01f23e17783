#pragma once
/// Resampling between parametrisations of the sphere.

#include <cmath>
#include <functional>
#include <optional>

#include <ssphh/core/parallel.h>
#include <ssphh/image/image.h>

namespace ssphh::image {

/// Radiance by direction, and the smallest angle [rad] over which it varies (its texels).
struct SphereField {
  std::function<vec3(const vec3&)> value;
  float texel_angle;
};

/// A place of the new image: direction and solid angle per unit area, up to a common factor.
struct WeightedDirection {
  vec3 direction;
  float weight;
};

/// New image whose pixels are means of the field over their solid angles. `place(u, v)`, with u and v in [0,
/// 1] over the image, gives std::optional<WeightedDirection>; pixels without any are black. `pixel_angle`
/// [rad] is the largest angle across a pixel.
template <class Place>
Image gather(int width, int height, float pixel_angle, const SphereField& field, const Place& place,
             const Control& control) {
  Image image(width, height);
  const int grid = std::max(1, static_cast<int>(std::ceil(3 * pixel_angle / field.texel_angle)));
  const float du = 1 / static_cast<float>(width), dv = 1 / static_cast<float>(height),
              step = 1 / static_cast<float>(grid);
  const auto mean = [&](int x, int y) {
    vec3 sum(0);
    float weights = 0;
    for (int j = 0; j < grid; ++j) {
      const float v = (static_cast<float>(y) + (static_cast<float>(j) + 0.5f) * step) * dv;
      vec3 row(0);
      float row_weights = 0;
      for (int i = 0; i < grid; ++i) {
        const float u = (static_cast<float>(x) + (static_cast<float>(i) + 0.5f) * step) * du;
        const std::optional<WeightedDirection> sample = place(u, v);
        if (!sample) continue;
        row += sample->weight * field.value(sample->direction);
        row_weights += sample->weight;
      }
      sum += row, weights += row_weights;
    }
    return weights > 0 ? sum / weights : vec3(0);
  };
  parallel_for(
      static_cast<std::size_t>(height), 1,
      [&](std::size_t begin, std::size_t end) {
        for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
          for (int x = 0; x < width; ++x) image.set_rgb(x, y, mean(x, y));
        }
      },
      control);
  return image;
}

}  // namespace ssphh::image
