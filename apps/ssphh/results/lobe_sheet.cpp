#include "results/lobe_sheet.h"

#include <algorithm>
#include <cmath>

#include <ssphh/sketch/draw.h>

namespace ssphh::app {
namespace {

constexpr float elevation = pi / 9, azimuth = -pi / 3;
constexpr float share_of_cell = 0.46f;  // that a lobe reaches from its middle, at most

/// Parallel rays; the picture's middle is the origin and a pixel is a metre.
struct View {
  vec3 right, up, toward_eye;

  /// `pole` is the axis that points up: 2 for z, 1 for y; the axes after it are those of the azimuth.
  explicit View(int pole) {
    const auto turned = [pole](float a, float b, float c) {
      vec3 v;
      v[(pole + 1) % 3] = a, v[(pole + 2) % 3] = b, v[pole] = c;
      return v;
    };
    toward_eye = turned(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                        std::sin(elevation));
    right = turned(-std::sin(azimuth), std::cos(azimuth), 0);
    up = glm::cross(toward_eye, right);
  }
  sketch::Eye eye(int width, int height) const {
    const float x0 = 0.5f * static_cast<float>(width), y0 = 0.5f * static_cast<float>(height);
    const float away = static_cast<float>(width + height);
    return {[=, *this](float x, float y) -> sketch::Ray {
      return {(x - x0) * right + (y0 - y) * up + away * toward_eye, -toward_eye};
    }};
  }
};

image::Image draw_lobes(int width, int height, sketch::Sketch lobes, int size, const View& view,
                        const Control& control) {
  image::Image picture(width, height);
  std::ranges::fill(picture.pixels, 1.0f);
  const std::vector<float> largest = sketch::largest_values(lobes.lobes);
  for (std::size_t i = 0; i < largest.size(); ++i) {
    const float reach = share_of_cell * static_cast<float>(size);
    lobes.lobes[i].scale = largest[i] > 0 ? reach / largest[i] : 0;
  }
  sketch::draw(picture, lobes, view.eye(width, height), {}, control);
  return picture;
}

}  // namespace

image::Image basis_sheet(int degree, int size, const Control& control) {
  sh::require_degree(degree, "sh plot");
  const View view(2);
  const int width = (2 * degree + 1) * size, height = (degree + 1) * size;
  const auto cell = static_cast<float>(size);
  sketch::Sketch lobes;
  for (int l = 0; l <= degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      sketch::Lobe lobe;
      lobe.center = cell * (static_cast<float>(m) * view.right +
                            (0.5f * static_cast<float>(degree) - static_cast<float>(l)) * view.up);
      lobe.values.assign(static_cast<std::size_t>(sh::coefficient_count(l)), 0.0f);
      lobe.values[sh::coefficient_index(l, m)] = 1;
      lobes.lobes.push_back(std::move(lobe));
    }
  }
  return draw_lobes(width, height, std::move(lobes), size, view, control);
}

image::Image lobe_picture(const sh::RadianceSh& light, int size, const Control& control) {
  sketch::Lobe lobe;
  for (const vec3& value : light.values) lobe.values.push_back(luminance(value));
  sketch::Sketch sketch;
  sketch.lobes.push_back(std::move(lobe));
  return draw_lobes(size, size, std::move(sketch), size, View(1), control);
}

}  // namespace ssphh::app
