#include <cmath>

#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>

#include "distant_lights.h"

namespace ssphh::shading {
namespace {

/// Luminance of row y's bilinear interpolant averaged over each pixel: a [1 6 1]/8 tent in both directions.
/// Positive wherever the interpolant is, so that sampling reaches all of it.
std::vector<float> row_importance(const image::Image& image, int y) {
  const int width = image.width, height = image.height;
  const auto value = [&](int x, int row) {
    const float l = luminance(image.rgb(x, row));
    return std::isfinite(l) ? glm::max(l, 0.0f) : 0.0f;
  };
  std::vector<float> vertical(static_cast<std::size_t>(width)), result(vertical.size());
  for (int x = 0; x < width; ++x) {
    // Beyond a pole lies the same row, half a turn away
    const int opposite = (x + width / 2) % width;
    const float above = y > 0 ? value(x, y - 1) : value(opposite, 0);
    const float below = y + 1 < height ? value(x, y + 1) : value(opposite, height - 1);
    vertical[x] = (above + 6 * value(x, y) + below) / 8;
  }
  for (int x = 0; x < width; ++x) {
    const auto at = [&](int column) { return vertical[(column + width) % width]; };
    result[x] = (at(x - 1) + 6 * at(x) + at(x + 1)) / 8;
  }
  return result;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const scene::Environment& environment, int group)
    : EnvironmentLight(environment.color, environment.rotation, group,
                       environment.equirect.empty() ? nullptr : &environment.equirect) {}

EnvironmentLight::EnvironmentLight(std::shared_ptr<const image::Image> image, const vec3& color,
                                   float rotation, int group)
    : EnvironmentLight(color, rotation, group, image.get()) {
  held_ = std::move(image);
}

EnvironmentLight::EnvironmentLight(const vec3& color, float rotation, int group, const image::Image* image)
    : image_(image),
      color_(color),
      rotation_(rotation),
      cos_(std::cos(rotation)),
      sin_(std::sin(rotation)),
      group_(group),
      mean_irradiance_(pi * luminance(color)) {
  if (image_ == nullptr) return;
  const int width = image_->width, height = image_->height;
  std::vector<float> row_power(static_cast<std::size_t>(height));
  double total = 0;
  for (int y = 0; y < height; ++y) {
    const std::vector<float> importance = row_importance(*image_, y);
    columns_.emplace_back(importance);
    double sum = 0;
    for (const float v : importance) sum += static_cast<double>(v);
    sum *= image::equirect_solid_angle(y, width, height);
    row_power[y] = static_cast<float>(sum);
    total += sum;
  }
  rows_ = Distribution(row_power);
  mean_irradiance_ *= static_cast<float>(total / (4 * pi_d));
  for (int y = 0; y <= height; ++y) row_cos_.push_back(static_cast<float>(std::cos(pi_d * y / height)));
}

EnvironmentLight EnvironmentLight::turned(float rotation) const {
  EnvironmentLight other = *this;
  other.rotation_ = rotation;
  other.cos_ = std::cos(rotation), other.sin_ = std::sin(rotation);
  return other;
}

vec3 EnvironmentLight::lookup(const vec3& image_direction) const {
  return color_ * image::sample_equirect(*image_, image_direction);
}

vec3 EnvironmentLight::radiance(const vec3& direction) const {
  return image_ == nullptr ? color_ : lookup(to_image(direction));
}

float EnvironmentLight::pdf(const vec3& direction) const {
  if (image_ == nullptr) return 1 / (4 * pi);
  if (rows_.empty()) return 0;
  const int width = image_->width, height = image_->height;
  const vec2 uv = image::equirect_uv(to_image(direction));
  const int x = glm::min(static_cast<int>(uv.x * static_cast<float>(width)), width - 1);
  const int y = glm::min(static_cast<int>(uv.y * static_cast<float>(height)), height - 1);
  const auto row = static_cast<std::size_t>(y);
  if (columns_[row].empty()) return 0;
  const float solid_angle = 2 * pi / static_cast<float>(width) * (row_cos_[row] - row_cos_[row + 1]);
  return rows_.probability(row) * columns_[row].probability(static_cast<std::size_t>(x)) / solid_angle;
}

EnvironmentLight::Sample EnvironmentLight::sample(const vec2& u) const {
  if (image_ == nullptr) {
    const vec3 wi = sample_uniform_sphere(u);
    return {wi, color_, 1 / (4 * pi)};
  }
  if (rows_.empty()) return {vec3(0, 1, 0), vec3(0), 0};

  // Choose a pixel, then a direction in it, uniform in solid angle
  const Distribution::Choice row = rows_.sample(u.y);
  const Distribution::Choice column = columns_[row.index].sample(u.x);
  const float top = row_cos_[row.index], bottom = row_cos_[row.index + 1];
  const float cos_theta = top + row.u * (bottom - top);
  const float sin_theta = std::sqrt(glm::max(1 - cos_theta * cos_theta, 0.0f));
  const float width = static_cast<float>(image_->width);
  // The image's left edge lies half a turn from +x
  const vec2 horizontal = -sin_theta * unit_circle((static_cast<float>(column.index) + column.u) / width);
  const vec3 d(horizontal.x, cos_theta, horizontal.y);
  const float solid_angle = 2 * pi / width * (top - bottom);
  return {to_world(d), lookup(d), row.probability * column.probability / solid_angle};
}

}  // namespace ssphh::shading
